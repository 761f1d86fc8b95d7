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
/// view is straight up or down or target is at eye.
SE3 look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

struct PathOptions {
  double fps = 30.0;          // [1/s] > 0
  int frames = 240;           // >= 2
  bool closed = false;        // true: ends one frame before the start, as a loop
  double tremor_m = 0.004;    // [m] standard deviation of each coordinate of the eye's tremor, 0..0.05
  double tremor_rad = 0.006;  // [rad] the same for rotation, 0..0.1
  double max_speed = 1.5;     // [m/s] > 0
  double max_turn = 1.57;     // [rad/s] > 0; 1.57 is 3 degrees a frame at 30 fps
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Share of the way done at share t of the time: 0 to 1, with a tenth of the time spent on speeding up and as much on
/// slowing down.
double eased(double t);

/// A hand-held path. Eye and target follow a PathSpline through the waypoints, with a pace that starts and ends slowly
/// if the path is open; upon it lies Tremor. Stamps are k / fps.
/// Speed and turn rate between frames never exceed max_speed and max_turn: where they would, an InputError says how
/// many frames the path needs at least. At least 2 waypoints (3 if closed).
Trajectory hand_held_path(const std::vector<Waypoint>& waypoints, const PathOptions& options);

}  // namespace odosplat
