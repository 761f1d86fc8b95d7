// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace odosplat {

/// Where a person with a camera stands and what is looked at; the path goes smoothly through these.
struct Waypoint {
  Eigen::Vector3d eye;     // [m] world
  Eigen::Vector3d target;  // [m] world, at least 0.2 m from eye
};

/// Eye and target of a path on the way through waypoints. Source: centripetal Catmull-Rom spline (Catmull and Rom 1974,
/// knots after Yuksel et al. 2011) over the sum of square roots of the eyes' (and, by half, the targets') distances.
/// Throws InputError for fewer than 2 waypoints (3 if closed), one that is not finite, or a target nearer than 0.2 m to
/// its eye.
class PathSpline {
 public:
  using Point = Eigen::Matrix<double, 6, 1>;  // eye, target [m]

  PathSpline(const std::vector<Waypoint>& waypoints, bool closed);

  /// Parameter at the end; at the start it is 0.
  double length() const { return knots_.back(); }
  bool closed() const { return closed_; }
  /// s in 0..length().
  Point operator()(double s) const;

 private:
  const Point& control(int i) const { return points_[static_cast<std::size_t>(i)]; }
  Point at(int i) const;

  std::vector<Point> points_;
  bool closed_;
  std::vector<double> knots_;
};

}  // namespace odosplat
