// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/even_rows.hpp"
#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

/// One image on its way through the odometry: the front end fills in its pose and brightness, the back end makes a
/// keyframe of it.
struct PosedFrame {
  int number = 0;     // counts images from 0
  double time = 0.0;  // [s]
  EvenFrame image;
  SE3 T_world_camera;
  /// Of the camera since the image before: T_camera_world(t) = exp(t velocity) T_camera_world; 0 where it is unknown.
  Vector6d velocity = Vector6d::Zero();
  Brightness brightness;
};

}  // namespace odosplat
