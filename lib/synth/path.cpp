// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double min_target_distance = 0.2;  // [m]

using Point = Eigen::Matrix<double, 6, 1>;  // eye, target

/// Centripetal Catmull-Rom spline through points, over the sum of square roots of the eyes' (and, weighted, the
/// targets') distances.
class Spline {
 public:
  Spline(std::vector<Point> points, bool closed) : points_(std::move(points)), closed_(closed) {
    const int segments = static_cast<int>(points_.size()) - (closed ? 0 : 1);
    knots_.push_back(0.0);
    for (int i = 0; i < segments; ++i) knots_.push_back(knots_.back() + gap(at(i), at(i + 1)));
  }

  double length() const { return knots_.back(); }

  Point operator()(double s) const {
    int i = static_cast<int>(std::upper_bound(knots_.begin(), knots_.end(), s) - knots_.begin()) - 1;
    i = std::clamp(i, 0, static_cast<int>(knots_.size()) - 2);
    const std::array<Point, 4> p{at(i - 1), at(i), at(i + 1), at(i + 2)};
    std::array<double, 4> k{};
    k[1] = knots_[static_cast<std::size_t>(i)];
    k[0] = k[1] - gap(p[0], p[1]);
    k[2] = knots_[static_cast<std::size_t>(i) + 1];
    k[3] = k[2] + gap(p[2], p[3]);
    // Barry and Goldman 1988: repeated linear interpolation.
    auto lerp = [&](const Point& a, const Point& b, double ka, double kb) -> Point {
      return ((kb - s) * a + (s - ka) * b) / (kb - ka);
    };
    const Point a1 = lerp(p[0], p[1], k[0], k[1]);
    const Point a2 = lerp(p[1], p[2], k[1], k[2]);
    const Point a3 = lerp(p[2], p[3], k[2], k[3]);
    const Point b1 = lerp(a1, a2, k[0], k[2]);
    const Point b2 = lerp(a2, a3, k[1], k[3]);
    return lerp(b1, b2, k[1], k[2]);
  }

 private:
  static double gap(const Point& a, const Point& b) {
    const double d = (a - b).head<3>().norm() + 0.5 * (a - b).tail<3>().norm();
    return std::sqrt(std::max(d, 1e-6));
  }

  /// Control point i; beyond the ends of an open path the last segment is reflected.
  Point at(int i) const {
    const int n = static_cast<int>(points_.size());
    auto point = [&](int k) -> const Point& { return points_[static_cast<std::size_t>(k)]; };
    if (closed_) return point(((i % n) + n) % n);
    if (i < 0) return 2.0 * point(0) - point(1);
    if (i >= n) return 2.0 * point(n - 1) - point(n - 2);
    return point(i);
  }

  std::vector<Point> points_;
  bool closed_;
  std::vector<double> knots_;
};

/// One coordinate of the tremor: variance 1 over time.
class Tremor {
 public:
  Tremor(Random& random, double duration, bool closed) {
    double power = 0.0;
    for (int i = 0; i < 24; ++i) {
      double frequency = 0.3 * std::pow(9.0 / 0.3, (i + random.uniform()) / 24.0);
      // On a loop each wave must close.
      if (closed) frequency = std::max(1.0, std::round(frequency * duration)) / duration;
      const double roll_off = 1.0 + std::pow(frequency / 3.0, 4.0);
      const double amplitude = 1.0 / (frequency * std::sqrt(roll_off));
      waves_.push_back({frequency, amplitude, random.uniform(0.0, 2.0 * pi)});
      power += 0.5 * amplitude * amplitude;
    }
    for (Wave& w : waves_) w.amplitude /= std::sqrt(power);
  }

  double operator()(double time) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += w.amplitude * std::sin(2.0 * pi * w.frequency * time + w.phase);
    return sum;
  }

 private:
  struct Wave {
    double frequency;  // [Hz]
    double amplitude;
    double phase;  // [rad]
  };
  std::vector<Wave> waves_;
};

/// Share of the way done at share t of the time: 0 to 1, with a tenth of the time spent on speeding up and as much on
/// slowing down.
double eased(double t) {
  constexpr double ramp = 0.1;
  const double area = 1.0 - ramp;
  if (t < ramp) return 0.5 * t * t / ramp / area;
  if (t > 1.0 - ramp) return 1.0 - 0.5 * (1.0 - t) * (1.0 - t) / ramp / area;
  return (t - 0.5 * ramp) / area;
}

}  // namespace

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
  require(waypoints.size() >= (options.closed ? 3U : 2U), "waypoints", "at least 2, or 3 for a closed path");
  std::vector<Point> points;
  points.reserve(waypoints.size());
  for (const Waypoint& w : waypoints) {
    require(w.eye.allFinite() && w.target.allFinite() && (w.target - w.eye).norm() >= min_target_distance, "waypoint",
            "finite, with its target at least 0.2 m from its eye");
    points.emplace_back();
    points.back() << w.eye, w.target;
  }
  const Spline spline(points, options.closed);
  const double duration = (options.frames - (options.closed ? 0 : 1)) / options.fps;
  Random random(options.seed);
  std::vector<Tremor> tremor;
  tremor.reserve(6);
  for (int i = 0; i < 6; ++i) tremor.emplace_back(random, duration, options.closed);

  Trajectory path;
  double worst = 0.0;  // how many times too fast
  for (int k = 0; k <= options.frames; ++k) {
    const double time = k / options.fps;
    const double share = std::min(time / duration, 1.0);
    const Point p = spline((options.closed ? share : eased(share)) * spline.length());
    const Eigen::Vector3d shift(tremor[0](time), tremor[1](time), tremor[2](time));
    const Eigen::Vector3d turn(tremor[3](time), tremor[4](time), tremor[5](time));
    const SE3 T_world_steady = look_at(p.head<3>() + options.tremor_m * shift, p.tail<3>());
    const SE3 T_steady_camera(so3_exp(options.tremor_rad * turn), Eigen::Vector3d::Zero());
    const SE3 T_world_camera = T_world_steady * T_steady_camera;
    // A closed path is followed one frame further, to its start, for the sake of this check.
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
