// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/camera/camera.hpp"

namespace odosplat {

/// Errors of a given camera calibration: with x and y a point's ray at depth 1 and r^2 = x^2 + y^2,
/// u = fx ((1 + focal) x (1 + radial r^2) + center_u) + cx, v likewise. `readout` adds to the camera's: a row is taken
/// the sum of both times Camera::time_of_row after the image's time; the ray is the one seen then.
struct CameraCorrection {
  static constexpr int size = 5;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  double focal = 0.0;
  double center_u = 0.0;
  double center_v = 0.0;
  double radial = 0.0;
  double readout = 0.0;  // [s]

  Vector vector() const { return {focal, center_u, center_v, radial, readout}; }
  static CameraCorrection from(const Vector& v) { return {v[0], v[1], v[2], v[3], v[4]}; }

  /// Pixel of a point in front of the camera, z > 0.
  Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& p_camera) const {
    const double x = p_camera.x() / p_camera.z();
    const double y = p_camera.y() / p_camera.z();
    const double s = stretch(x * x + y * y);
    return {camera.fx * (s * x + center_u) + camera.cx, camera.fy * (s * y + center_v) + camera.cy};
  }
  /// Factor of a point's ray at depth 1, at a squared distance from the axis there.
  double stretch(double r2) const { return (1.0 + focal) * (1.0 + radial * r2); }
  /// The point at depth 1 on the ray of a pixel: the inverse of project(), by fixed-point iteration.
  Eigen::Vector3d ray(const Camera& camera, double u, double v) const {
    constexpr int steps = 40;
    const Eigen::Vector2d distorted(((u - camera.cx) / camera.fx - center_u) / (1.0 + focal),
                                    ((v - camera.cy) / camera.fy - center_v) / (1.0 + focal));
    Eigen::Vector2d q = distorted;
    for (int k = 0; k < steps && radial != 0.0; ++k) {
      const Eigen::Vector2d before = q;
      q = distorted / (1.0 + radial * q.squaredNorm());
      if ((q - before).squaredNorm() < 1e-20) break;
    }
    return {q.x(), q.y(), 1.0};
  }
};

}  // namespace odosplat
