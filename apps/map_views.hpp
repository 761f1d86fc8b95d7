// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "odosplat/map/map_view.hpp"
#include "odosplat/map/sensor_view.hpp"
#include "odosplat/viewer/map_points.hpp"
#include "support.hpp"

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

/// A map behind the interface that the odometry knows, with the device it runs on if it needs one.
struct OpenedView {
  std::unique_ptr<MapView> view;
  std::optional<compute::Context> device;
  SensorView* sensor = nullptr;  // method rgbd: set_depth() before each frame; else null
};

/// gaussian: Gaussians of --map, depth by ray planes, normalised; paper: the same with the paper's blended depth;
/// interpolation: depth interpolated in --cloud; rgbd: the sequence's own depth images.
/// InputError for another word or a file that the method needs and was not given.
OpenedView open_view(const Common& common, const std::string& method, const MapFlags& flags);

/// What the figures draw: the Gaussians' discs if there is a map, else the points of the cloud.
MapPoints read_map_points(const MapFlags& flags);

}  // namespace odosplat::apps
