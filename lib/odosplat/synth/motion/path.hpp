// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/synth/motion/path_spline.hpp"

namespace odosplat {

/// Pose of a camera at eye [m] that looks at target, image upright (the world's z axis is up). Throws InputError if the
/// viewing direction is vertical or target equals eye.
SE3 look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

struct PathOptions {
  double fps = 30.0;          // [1/s] > 0
  int frames = 240;           // >= 2
  bool closed = false;        // true: a loop; the last frame is one frame before the start
  double tremor_m = 0.004;    // [m] standard deviation of each coordinate of the eye's tremor, 0..0.05
  double tremor_rad = 0.006;  // [rad] the same for rotation, 0..0.1
  double max_speed = 1.5;     // [m/s] > 0
  double max_turn = 1.57;     // [rad/s] > 0; 1.57 is 3 degrees per frame at 30 fps
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Share of the way covered at share t of the time, 0 to 1. The first and the last tenth of the time are acceleration
/// and deceleration.
double eased(double t);

/// A hand-held path. Eye and target follow a PathSpline through the waypoints, with acceleration and deceleration at
/// the ends if the path is open; Tremor is added. Stamps are k / fps. At least 2 waypoints (3 if closed).
/// Throws InputError, with the number of frames that the path needs at least, if speed or turn rate between frames
/// would exceed max_speed or max_turn.
Trajectory hand_held_path(const std::vector<Waypoint>& waypoints, const PathOptions& options);

}  // namespace odosplat
