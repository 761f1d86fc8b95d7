// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// How the views that a map was trained on are thinned to the places that its file stores.
struct MapPlacesOptions {
  double distance = 0.15;      // [m] a view within this and `angle` of a kept one is left out
  double angle = 10.0 / 57.3;  // [rad]
  int most = 1000;             // distance and angle are increased until no more are left

  /// Throws InputError naming the field.
  void check() const;
};

/// Selects greedily, in order: a view is kept if it is near none that was kept before. T_world_camera.
std::vector<SE3> thinned_places(const std::vector<SE3>& views, const MapPlacesOptions& options = {});

/// Lines "training_view tx ty tz qx qy qz qw" (T_world_camera [m], unit quaternion) for the header of a map, and back.
/// Other lines are ignored. places_from_lines throws InputError for a view that is not seven finite numbers or has no
/// rotation.
std::vector<std::string> place_lines(const std::vector<SE3>& places);
std::vector<SE3> places_from_lines(const std::vector<std::string>& lines);

}  // namespace odosplat
