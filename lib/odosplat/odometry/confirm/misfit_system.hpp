// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <limits>

#include "odosplat/camera/camera_correction.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

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
  /// Where a pose was searched for, less suffices to refuse it: a search makes up for a wrong camera by a wrong pose.
  static constexpr double likely_sigmas = 2.0;
  /// The calibration counts as right until an error is significant (Odometry is stricter with poses that must be
  /// confirmed). Images of a flat wall, for example, determine none.
  bool significant() const { return sigmas >= significant_sigmas; }
};

/// How far errors of the calibration may move a pose that is accepted.
struct MisfitLimits {
  double translation = std::numeric_limits<double>::infinity();  // [m]
  double rotation = std::numeric_limits<double>::infinity();     // [rad]

  /// False if an error that is probable by so many standard deviations moves the pose by more.
  bool allow(const MisfitEffect& effect, double sigmas) const {
    return effect.sigmas < sigmas || (effect.meters <= translation && effect.radians <= rotation);
  }
};

}  // namespace odosplat
