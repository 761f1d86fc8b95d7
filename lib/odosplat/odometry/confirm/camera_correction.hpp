// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Errors of the given camera calibration, as seen in comparison with the map: with x and y a point's ray at depth 1
/// and r^2 = x^2 + y^2, u = fx ((1 + focal) x (1 + radial r^2) + center_u) + cx, v likewise.
struct CameraCorrection {
  static constexpr int size = 4;
  double focal = 0.0;
  double center_u = 0.0;
  double center_v = 0.0;
  double radial = 0.0;

  Eigen::Vector4d vector() const { return {focal, center_u, center_v, radial}; }
  static CameraCorrection from(const Eigen::Vector4d& v) { return {v[0], v[1], v[2], v[3]}; }
};

/// Normal equations of one image's remaining shifts against the map: of the pose (twist on the left of T_camera_world,
/// rows 0 to 5) and of the camera (rows 6 to 9). Their solution is the right values minus those at which the residuals
/// were computed.
struct MisfitSystem {
  Eigen::Matrix<double, 10, 10> information = Eigen::Matrix<double, 10, 10>::Zero();
  Eigen::Matrix<double, 10, 1> vector = Eigen::Matrix<double, 10, 1>::Zero();
  double noise = 0.0;  // variance of one residual, of normalised grey values
  int patches = 0;
};

/// How far an image's pose would move with the right calibration (CameraMisfit). Zero if no error is significant.
struct MisfitEffect {
  double meters = 0.0;                     // of the camera's place
  double radians = 0.0;                    // of its direction
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera: the move itself, and its
                                           // uncertainty
};

}  // namespace odosplat
