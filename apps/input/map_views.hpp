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

/// Files that a method's map is read from.
struct MapFlags {
  std::string map{};           // of Gaussians
  std::string cloud{};         // point cloud
  std::string depth{};         // depth mode of Gaussians: surface, expected, median, blended; empty: the method's
  std::string without_half{};  // "+x", "-x", ... "-z": the half of the map on that side is left out; empty: none
};

/// One half of a map: all that lies beyond the median of its points along an axis.
struct MapHalf {
  Eigen::Index axis;
  float sign;
  float border;  // [m] sign * median
  bool contains(const Eigen::Vector3f& p_world) const { return sign * p_world[axis] > border; }
};
/// side: as in MapFlags; InputError for another word.
MapHalf map_half(const MapFlags& flags, const std::string& side);

void add_map_flags(CLI::App* command, MapFlags& flags);

/// Noise that is added to the depth images of method rgbd.
struct DepthNoiseFlags {
  std::string model = "none";  // or kinect
  std::uint64_t seed = 1;
};

/// Declares --depth-noise.
void add_depth_noise_flag(CLI::App* command, DepthNoiseFlags& flags);

/// A map as a MapView for the odometry, with the device it runs on if it needs one.
struct OpenedView {
  std::unique_ptr<MapView> view;
  std::optional<compute::Context> device;
  SensorView* sensor = nullptr;  // method rgbd; else null
  std::optional<KinectOptions> depth_noise;

  /// To be called before a frame is tracked or evaluated: for method rgbd, sets the frame's depth image, with noise if
  /// requested. Does nothing for maps, which do not depend on the frame.
  void show_frame(const Sequence& sequence, std::size_t i);
};

/// Opens the map that the method's preset needs: the Gaussians of --map, the cloud of --cloud (interpolated or as
/// surfels), or the sequence's depth images. InputError for an unknown method or a required file that is not given.
OpenedView open_view(const Common& common, const std::string& method, const MapFlags& flags,
                     const DepthNoiseFlags& noise = {});

/// Checks for flags that the method does not use: InputError for --depth and --depth-noise, which would be expected to
/// change the results; a warning for --cloud in addition to a map, and for a map that was not trained with the method's
/// preset.
void check_flags_of_method(const std::string& method, const MapFlags& flags, const DepthNoiseFlags& noise = {});

/// What the figures draw: the Gaussians as discs if there is a map, otherwise the points of the cloud.
MapPoints read_map_points(const MapFlags& flags);

}  // namespace odosplat::apps
