// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/motion_model.hpp"

namespace odosplat {

void MotionHistory::add(double time, const SE3& T_world_camera) {
  has_velocity = has_last && time > last_time;
  previous = last;
  previous_time = last_time;
  last = T_world_camera;
  last_time = time;
  has_last = true;
}

void MotionHistory::move(const SE3& T_new_old) {
  last = T_new_old * last;
  previous = T_new_old * previous;
}

namespace {

/// The last pose moved on by the last step, scaled by s.
SE3 continued(const MotionHistory& history, double s) {
  if (!history.has_velocity) return history.last;
  const Vector6d step = (history.previous.inverse() * history.last).log();
  return history.last * SE3::exp(s * step);
}

}  // namespace

double steps_ahead(const MotionHistory& history, double time) {
  if (!history.has_velocity) return 0.0;
  const double dt = history.last_time - history.previous_time;
  // Over a long gap the velocity predicts nothing.
  const double s = (time - history.last_time) / dt;
  return s > 0.0 && s < 5.0 ? s : 0.0;
}

SE3 predict(const MotionHistory& history, double time) { return continued(history, steps_ahead(history, time)); }

Vector6d velocity_to(const MotionHistory& history, double time, const SE3& T_world_camera) {
  return (T_world_camera.inverse() * history.last).log() / (time - history.last_time);
}

std::vector<SE3> motion_guesses(const MotionHistory& history, double time, const SE3& T_world_keyframe) {
  const double s = steps_ahead(history, time);
  std::vector<SE3> guesses{continued(history, s)};
  if (s > 0.0) {
    guesses.push_back(continued(history, 2.0 * s));
    guesses.push_back(continued(history, 0.5 * s));
    guesses.push_back(history.last);
  }
  guesses.push_back(T_world_keyframe);
  return guesses;
}

std::vector<SE3> rotated_guesses(const SE3& T_world_camera, double angle) {
  std::vector<SE3> guesses;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // no turn at all
    const int second = i / 3;
    const int third = i / 9;
    const Eigen::Vector3d axis(i % 3 - 1, second % 3 - 1, third - 1);
    guesses.push_back(T_world_camera * SE3(so3_exp(angle * axis), Eigen::Vector3d::Zero()));
  }
  return guesses;
}

}  // namespace odosplat
