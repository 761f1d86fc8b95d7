// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/command/support.hpp"
#include "apps/input/method.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/map/sensor_view.hpp"
#include "odosplat/synth/sensor/kinect.hpp"
#include "viewer/map_points.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// Where a method's map comes from.
struct MapFlags {
  std::string map{};           // of Gaussians
  std::string cloud{};         // point cloud
  std::string depth{};         // of Gaussians: surface, expected, median, blended; empty: the method's
  std::string without_half{};  // "+x", "-x", ... "-z": the half of the map on that side is left out; empty: all of it
};

/// One of the two halves of a map: what lies beyond the median of its points along an axis.
struct MapHalf {
  Eigen::Index axis;
  float sign;
  float border;  // [m] sign * median
  bool contains(const Eigen::Vector3f& p_world) const { return sign * p_world[axis] > border; }
};
/// side: as in MapFlags; InputError for another word.
MapHalf map_half(const MapFlags& flags, const std::string& side);

void add_map_flags(CLI::App* command, MapFlags& flags);

/// Noise that the depth of method rgbd gets before use.
struct DepthNoiseFlags {
  std::string model = "none";  // or kinect
  std::uint64_t seed = 1;
};

/// Declares --depth-noise.
void add_depth_noise_flag(CLI::App* command, DepthNoiseFlags& flags);

/// A map behind the interface that the odometry knows, with the device it runs on if it needs one.
struct OpenedView {
  std::unique_ptr<MapView> view;
  std::optional<compute::Context> device;
  SensorView* sensor = nullptr;  // method rgbd; else null
  std::optional<KinectOptions> depth_noise;

  /// To be called before a frame is tracked or judged: method rgbd shows its depth image, with noise if asked for. A
  /// map is what it is whatever the frame: nothing happens.
  void show_frame(const Sequence& sequence, std::size_t i);
};

/// The map that the method's preset names: Gaussians of --map, --cloud interpolated or as surfels, or the sequence's
/// own depth images. InputError for another word or a file that the method needs and was not given.
OpenedView open_view(const Common& common, const std::string& method, const MapFlags& flags,
                     const DepthNoiseFlags& noise = {});

/// Tells of flags that the method makes nothing of: InputError for --depth and --depth-noise, which somebody expects
/// other results from; a warning for --cloud beside a map, and for a map that is not of the method's own training.
void check_flags_of_method(const std::string& method, const MapFlags& flags, const DepthNoiseFlags& noise = {});

/// What the figures draw: the Gaussians' discs if there is a map, else the points of the cloud.
MapPoints read_map_points(const MapFlags& flags);

}  // namespace odosplat::apps
