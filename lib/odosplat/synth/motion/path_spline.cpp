// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/path_spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr double min_target_distance = 0.2;  // [m]

using Point = PathSpline::Point;

double gap(const Point& a, const Point& b) {
  const double d = (a - b).head<3>().norm() + 0.5 * (a - b).tail<3>().norm();
  return std::sqrt(std::max(d, 1e-6));
}

}  // namespace

PathSpline::PathSpline(const std::vector<Waypoint>& waypoints, bool closed) : closed_(closed) {
  require(waypoints.size() >= (closed ? 3U : 2U), "waypoints", "at least 2, or 3 for a closed path");
  for (const Waypoint& w : waypoints) {
    require(w.eye.allFinite() && w.target.allFinite() && (w.target - w.eye).norm() >= min_target_distance, "waypoint",
            "finite, with its target at least 0.2 m from its eye");
    points_.emplace_back();
    points_.back() << w.eye, w.target;
  }
  const int segments = static_cast<int>(points_.size()) - (closed ? 0 : 1);
  knots_.push_back(0.0);
  for (int i = 0; i < segments; ++i) knots_.push_back(knots_.back() + gap(at(i), at(i + 1)));
}

Point PathSpline::operator()(double s) const {
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

/// Control point i; beyond the ends of an open path the last segment is reflected.
Point PathSpline::at(int i) const {
  const int n = static_cast<int>(points_.size());
  if (closed_) return control(((i % n) + n) % n);
  if (i < 0) return 2.0 * control(0) - control(1);
  if (i >= n) return 2.0 * control(n - 1) - control(n - 2);
  return control(i);
}

}  // namespace odosplat
