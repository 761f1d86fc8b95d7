// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/map_views.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat::apps {

/// Help of the flag that gives the trajectory.
inline constexpr const char* places_help =
    "trajectory of views to look for the camera from (default: where the map says it was seen from)";

/// Poses from which the relocaliser looks for the camera in a map (T_world_camera): those of the trajectory `file` if
/// given, thinned; otherwise the poses of the training images, as stored in the map file; otherwise samples of the
/// space around the map's points (sampled_places, with a log message).
std::vector<SE3> places_of(const MapFlags& flags, const std::string& file);

/// Sampled poses in a map of which only the points are known [m, world]: a grid of 1 m at mid-height of the points'
/// bounding box, each with 12 level viewing directions; positions within 0.3 m of a point are left out. The shortest
/// side of the box is taken as vertical; up is -y if y is vertical (the cameras' convention), otherwise +z or +x. Less
/// reliable than poses that a camera had.
std::vector<SE3> sampled_places(const std::vector<Eigen::Vector3f>& points_world);

}  // namespace odosplat::apps
