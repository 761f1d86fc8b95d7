// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace odosplat {

/// Lens distortion on the plane z = 1, the model of Undistorter.
class LensModel {
 public:
  LensModel() = default;
  /// d: k1 k2 p1 p2 k3, or without k3.
  explicit LensModel(const std::vector<double>& d)
      : k1_(d[0]), k2_(d[1]), p1_(d[2]), p2_(d[3]), k3_(d.size() > 4 ? d[4] : 0.0) {}

  Eigen::Vector2d distorted(const Eigen::Vector2d& p) const {
    const double x = p.x();
    const double y = p.y();
    const double r2 = x * x + y * y;
    return {x * radial(r2) + 2.0 * p1_ * x * y + p2_ * (r2 + 2.0 * x * x),
            y * radial(r2) + p1_ * (r2 + 2.0 * y * y) + 2.0 * p2_ * x * y};
  }

  /// Derivative of r radial(r^2) by r: where it is not positive, the lens shows a ray twice.
  double radial_slope(double r2) const { return 1.0 + r2 * (3.0 * k1_ + r2 * (5.0 * k2_ + r2 * 7.0 * k3_)); }

  /// d distorted / d p
  Eigen::Matrix2d slope(const Eigen::Vector2d& p) const {
    const double r2 = p.squaredNorm();
    const double growth = 2.0 * (k1_ + r2 * (2.0 * k2_ + r2 * 3.0 * k3_));  // 2 d radial / d r^2
    Eigen::Matrix2d J = radial(r2) * Eigen::Matrix2d::Identity() + growth * p * p.transpose();
    J(0, 0) += 2.0 * p1_ * p.y() + 6.0 * p2_ * p.x();
    J(0, 1) += 2.0 * p1_ * p.x() + 2.0 * p2_ * p.y();
    J(1, 0) += 2.0 * p1_ * p.x() + 2.0 * p2_ * p.y();
    J(1, 1) += 6.0 * p1_ * p.y() + 2.0 * p2_ * p.x();
    return J;
  }

 private:
  double radial(double r2) const { return 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_)); }

  double k1_ = 0.0;
  double k2_ = 0.0;
  double p1_ = 0.0;
  double p2_ = 0.0;
  double k3_ = 0.0;
};

}  // namespace odosplat
