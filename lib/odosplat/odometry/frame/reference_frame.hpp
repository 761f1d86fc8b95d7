// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/confirm/map_confirmation.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {

/// A keyframe as the front end knows it: a copy of the back end's latest estimate, so that the back end may move its
/// keyframes meanwhile; the points are shared and never change.
struct ReferenceFrame {
  int id = -1;  // of the keyframe
  SE3 T_world_camera;
  Brightness brightness;
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera
  std::shared_ptr<const TrackingReference> points;
  std::shared_ptr<const ViewPatches> patches;  // of the map, rendered from there; null: the map has no colours
  bool in_map = false;                         // its depth is the map's
  MisfitEffect misfit;                         // effect of errors of the camera's calibration on its pose
};

}  // namespace odosplat
