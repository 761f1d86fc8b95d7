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

/// Poses from which a map can be looked at to find a camera in it (T_world_camera): those of the trajectory `file` if
/// one is given, thinned; else where the map's training images were taken, as its file says; else samples of the space
/// around its points (sampled_places). Says on the log which.
std::vector<SE3> places_of(const MapFlags& flags, const std::string& file);

/// Poses in a map of which nothing is known but its points [m, world]: a grid of 1 m at mid-height of the box around
/// the points, each looking level in 12 directions; those within 0.3 m of a point are left out. The shortest side of
/// the box is taken for the vertical; up is -y in a world that has y vertical (the cameras' own convention), else +z or
/// +x. Weaker than poses that a camera had.
std::vector<SE3> sampled_places(const std::vector<Eigen::Vector3f>& points_world);

}  // namespace odosplat::apps
