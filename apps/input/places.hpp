// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/map_views.hpp"
#include "apps/input/sampled_places.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat::apps {

/// Help of the flag that gives the trajectory.
inline constexpr const char* places_help =
    "trajectory of views to look for the camera from (default: where the map says it was seen from)";

/// Poses from which the relocaliser looks for the camera in a map (T_world_camera): those of the trajectory `file` if
/// given, thinned; otherwise the poses of the training images, as stored in the map file; otherwise samples of the
/// space around the map's points (sampled_places, with a log message).
std::vector<SE3> places_of(const MapFlags& flags, const std::string& file);

}  // namespace odosplat::apps
