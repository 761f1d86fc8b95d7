// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/walk.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr int steps_a_unit = 400;  // entries of `pace_` per unit of the spline's parameter

SE3 steady_pose(const PathSpline::Point& p) { return look_at(p.head<3>(), p.tail<3>()); }

std::string metres(double length) { return formatted("%.2f m", length); }

}  // namespace

void WalkOptions::check() const {
  require(fps > 0.0 && std::isfinite(fps), "walk.fps", "positive");
  require(frames >= 2 && frames <= 1000000, "walk.frames", "in 2..1000000");
  require(length_m > 0.0 && std::isfinite(length_m), "walk.length_m", "positive");
  require(turn_m > 0.0 && std::isfinite(turn_m), "walk.turn_m", "positive");
  require(tremor_m >= 0.0 && tremor_m <= 0.05, "walk.tremor_m", "in 0..0.05");
  require(tremor_deg >= 0.0 && tremor_deg <= 5.0, "walk.tremor_deg", "in 0..5");
  require(max_speed > 0.0, "walk.max_speed", "positive");
  require(max_turn_deg > 0.0, "walk.max_turn_deg", "positive");
}

Walk::Walk(const std::vector<Waypoint>& waypoints, const WalkOptions& options)
    : options_(options), spline_(waypoints, options.loop) {
  options_.check();
  Random random(options.seed);
  const double duration = (options.frames - 1) / options.fps;
  for (int i = 0; i < 6; ++i) tremor_.emplace_back(random, duration, false);

  const int steps = std::max(1, static_cast<int>(spline_.length() * steps_a_unit));
  pace_.push_back(0.0);
  SE3 last = steady_pose(spline_(0.0));
  for (int i = 1; i <= steps; ++i) {
    const SE3 next = steady_pose(spline_(spline_.length() * i / steps));
    const SE3 T_last_next = last.inverse() * next;
    pace_.push_back(pace_.back() + std::hypot(T_last_next.translation().norm(), options.turn_m * T_last_next.angle()));
    last = next;
  }
  total_ = pace_.back();

  const double standing = travelled(0.0);
  if (standing >= options.length_m) {
    throw InputError("walk", "tremor alone travels " + metres(standing) + ", more than length_m");
  }
  double low = 0.0;
  double high = total_;
  if (options.loop) {
    while (travelled(high) < options.length_m) high *= 2.0;
  } else if (const double all = travelled(high); all < options.length_m) {
    throw InputError("walk", "its waypoints end after " + metres(all) + ", before length_m");
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (travelled(middle) < options.length_m ? low : high) = middle;
  }
  reach_ = high;

  double speed = 0.0;
  double turn = 0.0;
  const Trajectory path = trajectory();
  for (std::size_t k = 1; k < path.size(); ++k) {
    const SE3 T_last_camera = path[k - 1].T_world_camera.inverse() * path[k].T_world_camera;
    speed = std::max(speed, T_last_camera.translation().norm() * options.fps);
    turn = std::max(turn, T_last_camera.angle() / radians_per_degree);
  }
  if (speed > options.max_speed || turn > options.max_turn_deg) {
    throw InputError("walk", formatted("too fast: up to %.2f m/s and %.2f degrees a frame", speed, turn));
  }
}

SE3 Walk::pose_at(double time, double reach) const {
  const double duration = (options_.frames - 1) / options_.fps;
  double way = eased(std::clamp(time / duration, 0.0, 1.0)) * reach;
  if (spline_.closed()) way = std::fmod(way, total_);
  const auto after = std::upper_bound(pace_.begin() + 1, pace_.end() - 1, way);
  const auto i = static_cast<std::size_t>(after - pace_.begin());
  const double step = pace_[i] - pace_[i - 1];
  const double share = step > 0.0 ? std::clamp((way - pace_[i - 1]) / step, 0.0, 1.0) : 0.0;
  const double s = spline_.length() * (static_cast<double>(i - 1) + share) / static_cast<double>(pace_.size() - 1);
  const Eigen::Vector3d shift(tremor_[0](time), tremor_[1](time), tremor_[2](time));
  const Eigen::Vector3d turn(tremor_[3](time), tremor_[4](time), tremor_[5](time));
  const PathSpline::Point p = spline_(s);
  const SE3 T_world_steady = look_at(p.head<3>() + options_.tremor_m * shift, p.tail<3>());
  return T_world_steady * SE3(so3_exp(options_.tremor_deg * radians_per_degree * turn), Eigen::Vector3d::Zero());
}

SE3 Walk::pose_at(double time) const { return pose_at(time, reach_); }

double Walk::travelled(double reach) const {
  double sum = 0.0;
  Eigen::Vector3d last = pose_at(0.0, reach).translation();
  for (int k = 1; k < options_.frames; ++k) {
    const Eigen::Vector3d next = pose_at(k / options_.fps, reach).translation();
    sum += (next - last).norm();
    last = next;
  }
  return sum;
}

Trajectory Walk::trajectory() const {
  Trajectory path;
  for (int k = 0; k < options_.frames; ++k) path.push_back({k / options_.fps, pose_at(k / options_.fps), ""});
  return path;
}

double travelled_length(const Trajectory& path) {
  double sum = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    sum += (path[k].T_world_camera.translation() - path[k - 1].T_world_camera.translation()).norm();
  }
  return sum;
}

}  // namespace odosplat
