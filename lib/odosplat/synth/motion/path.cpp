// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/path.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/motion/path_spline.hpp"
#include "odosplat/synth/motion/tremor.hpp"

namespace odosplat {

SE3 look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d view = target - eye;
  const Eigen::Vector3d right = view.cross(Eigen::Vector3d::UnitZ());
  require(view.norm() > 1e-9 && right.norm() > 1e-6 * view.norm(), "look_at target",
          "away from the eye and not straight above or below it");
  Eigen::Matrix3d R;
  R.col(0) = right.normalized();
  R.col(2) = view.normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return {R, eye};
}

double eased(double t) {
  constexpr double ramp = 0.1;
  const double area = 1.0 - ramp;
  if (t < ramp) return 0.5 * t * t / ramp / area;
  if (t > 1.0 - ramp) return 1.0 - 0.5 * (1.0 - t) * (1.0 - t) / ramp / area;
  return (t - 0.5 * ramp) / area;
}

void PathOptions::check() const {
  require(fps > 0.0 && std::isfinite(fps), "path.fps", "positive");
  require(frames >= 2, "path.frames", "at least 2");
  require(tremor_m >= 0.0 && tremor_m <= 0.05, "path.tremor_m", "in 0..0.05");
  require(tremor_rad >= 0.0 && tremor_rad <= 0.1, "path.tremor_rad", "in 0..0.1");
  require(max_speed > 0.0, "path.max_speed", "positive");
  require(max_turn > 0.0, "path.max_turn", "positive");
}

Trajectory hand_held_path(const std::vector<Waypoint>& waypoints, const PathOptions& options) {
  options.check();
  const PathSpline spline(waypoints, options.closed);
  const double duration = (options.frames - (options.closed ? 0 : 1)) / options.fps;
  Random random(options.seed);
  std::vector<Tremor> tremor;
  tremor.reserve(6);
  for (int i = 0; i < 6; ++i) tremor.emplace_back(random, duration, options.closed);

  Trajectory path;
  double worst = 0.0;  // largest ratio of a speed or turn rate to its limit
  for (int k = 0; k <= options.frames; ++k) {
    const double time = k / options.fps;
    const double share = std::min(time / duration, 1.0);
    const PathSpline::Point p = spline((options.closed ? share : eased(share)) * spline.length());
    const Eigen::Vector3d shift(tremor[0](time), tremor[1](time), tremor[2](time));
    const Eigen::Vector3d turn(tremor[3](time), tremor[4](time), tremor[5](time));
    const SE3 T_world_steady = look_at(p.head<3>() + options.tremor_m * shift, p.tail<3>());
    const SE3 T_steady_camera(so3_exp(options.tremor_rad * turn), Eigen::Vector3d::Zero());
    const SE3 T_world_camera = T_world_steady * T_steady_camera;
    // For this check a closed path is followed by one more frame, to its start.
    if (k > 0 && (k < options.frames || options.closed)) {
      const SE3 T_last_camera = path.back().T_world_camera.inverse() * T_world_camera;
      worst = std::max({worst, T_last_camera.translation().norm() * options.fps / options.max_speed,
                        T_last_camera.angle() * options.fps / options.max_turn});
    }
    if (k < options.frames) path.push_back({time, T_world_camera, ""});
  }
  if (worst > 1.0) {
    throw InputError("path: too fast for " + std::to_string(options.frames) + " frames: needs about " +
                     std::to_string(static_cast<int>(std::ceil(worst * options.frames))));
  }
  return path;
}

}  // namespace odosplat
