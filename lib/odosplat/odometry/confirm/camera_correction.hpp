// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Errors of the given camera calibration, as seen in comparison with the map: with x and y a point's ray at depth 1
/// and r^2 = x^2 + y^2, u = fx ((1 + focal) x (1 + radial r^2) + center_u) + cx, v likewise. A rolling shutter takes
/// the row at a share s of the image's height at the image's time plus (s - 0.5) readout; the ray is the one seen then.
struct CameraCorrection {
  static constexpr int size = 5;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  double focal = 0.0;
  double center_u = 0.0;
  double center_v = 0.0;
  double radial = 0.0;
  double readout = 0.0;  // [s] from the first row to the last

  Vector vector() const { return {focal, center_u, center_v, radial, readout}; }
  static CameraCorrection from(const Vector& v) { return {v[0], v[1], v[2], v[3], v[4]}; }
};

/// Normal equations of one image's remaining shifts against the map: of the pose (twist on the left of T_camera_world,
/// rows 0 to 5) and of the camera (the others). Their solution is the right values minus those at which the residuals
/// were computed.
struct MisfitSystem {
  static constexpr int size = 6 + CameraCorrection::size;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  Matrix information = Matrix::Zero();
  Vector vector = Vector::Zero();
  double noise = 0.0;  // variance of one residual, of normalised grey values
  double flow = 0.0;   // [px/s] root mean square over the squares, on full size
  int patches = 0;
};

/// Change of the pose that fits an image best (twist on the left of T_camera_world) with the camera's correction.
struct PoseByCamera {
  SE3 T_world_camera;
  bool determined = false;  // false: the image could not be compared
  Eigen::Matrix<double, 6, CameraCorrection::size> change = Eigen::Matrix<double, 6, CameraCorrection::size>::Zero();
};

/// How far an image's pose would move with the right calibration (CameraMisfit).
struct MisfitEffect {
  double meters = 0.0;                     // of the camera's place
  double radians = 0.0;                    // of its direction
  double sigmas = 0.0;                     // of the largest error of the calibration, in its standard deviations; 0 if
                                           // it is too small to matter
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera: the move itself and its
                                           // uncertainty; 0 if the error is not significant

  static constexpr double significant_sigmas = 5.0;
  /// The calibration counts as right until an error is significant (Odometry is stricter with poses that must be
  /// confirmed). Images of a flat wall, for example, determine none.
  bool significant() const { return sigmas >= significant_sigmas; }
};

}  // namespace odosplat
