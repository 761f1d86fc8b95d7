// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Where the camera probably is, from where it was. Poses are T_world_camera, times [s] ascending.
struct MotionHistory {
  bool has_last = false;
  bool has_velocity = false;
  double last_time = 0.0;
  SE3 last;
  double previous_time = 0.0;
  SE3 previous;

  void add(double time, const SE3& T_world_camera);
  /// Forgets the velocity (after a loss), not the place.
  void stop() { has_velocity = false; }
  void clear() { *this = {}; }
  /// Replaces every pose T by T_new_old * T, after a correction of the keyframes.
  void move(const SE3& T_new_old);
};

/// Constant velocity in the camera's own frame; the last pose when there is no velocity. history.has_last must hold.
SE3 predict(const MotionHistory& history, double time);

/// Time from the last pose to `time`, in units of the interval between the last two poses; 0 where predict() gives the
/// last pose: without velocity, and over long gaps.
double steps_ahead(const MotionHistory& history, double time);

/// Mean velocity of the camera from the last pose to this one: T_camera_world(t) = exp(t velocity) T_camera_world.
/// time must be later than the last pose's.
Vector6d velocity_to(const MotionHistory& history, double time, const SE3& T_world_camera);

/// Guesses for the pose at `time`, best first: constant velocity, twice and half of it, standing still, and the pose of
/// `keyframe`. Source: DSO's list of motion hypotheses.
std::vector<SE3> motion_guesses(const MotionHistory& history, double time, const SE3& T_world_keyframe);

/// The pose turned in the camera's frame by the 26 rotation vectors whose components are -angle, 0 or angle [rad].
std::vector<SE3> rotated_guesses(const SE3& T_world_camera, double angle);

}  // namespace odosplat
