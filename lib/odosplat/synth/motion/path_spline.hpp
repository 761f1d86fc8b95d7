// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace odosplat {

/// A position of the camera and the point that it looks at. The path passes smoothly through its waypoints.
struct Waypoint {
  Eigen::Vector3d eye;     // [m] world
  Eigen::Vector3d target;  // [m] world, at least 0.2 m from eye
};

/// Eye and target along a path through waypoints: a centripetal Catmull-Rom spline (Catmull and Rom 1974, knots after
/// Yuksel et al. 2011). The knots are sums of square roots of the distances between the eyes plus half of those between
/// the targets. Throws InputError for fewer than 2 waypoints (3 if closed), one that is not finite, or a target nearer
/// than 0.2 m to its eye.
class PathSpline {
 public:
  using Point = Eigen::Matrix<double, 6, 1>;  // eye, target [m]

  PathSpline(const std::vector<Waypoint>& waypoints, bool closed);

  /// Parameter at the end of the path; 0 is its start.
  double length() const { return knots_.back(); }
  bool closed() const { return closed_; }
  /// The point at parameter s in 0..length().
  Point operator()(double s) const;

 private:
  const Point& control(int i) const { return points_[static_cast<std::size_t>(i)]; }
  Point at(int i) const;

  std::vector<Point> points_;
  bool closed_;
  std::vector<double> knots_;
};

}  // namespace odosplat
