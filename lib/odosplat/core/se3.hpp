// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace odosplat {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// [v]x, so that skew(v) * w = v.cross(w).
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation from a rotation vector [rad] and back (angle in [0, pi]). Both are exact to rounding at angle 0.
Eigen::Quaterniond so3_exp(const Eigen::Vector3d& omega);
Eigen::Vector3d so3_log(const Eigen::Quaterniond& q);

/// The rotation of a quaternion from a file or a command line: q scaled to unit length. All readers use this one rule:
/// the length must be in 0.5..2. Rounded numbers stay within that, while other data in the quaternion's columns usually
/// does not. Throws InputError("the quaternion has length 3, must be near 1 (0.5..2)") otherwise, also for a length
/// that is not finite.
Eigen::Quaterniond rotation_from_text(const Eigen::Quaterniond& q);

/// A rigid motion. Names carry both frames: p_world = T_world_camera * p_camera; T_a_c = T_a_b * T_b_c.
/// Twists are (translation rho, rotation omega) [m, rad]. Perturbations of a pose are on the LEFT everywhere in this
/// project: T <- exp(xi) * T. The quaternion is kept at unit length.
class SE3 {
 public:
  SE3() : q_(Eigen::Quaterniond::Identity()), t_(Eigen::Vector3d::Zero()) {}
  SE3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : q_(rotation.normalized()), t_(translation) {}
  /// R must be a rotation matrix; it is converted to a unit quaternion.
  SE3(const Eigen::Matrix3d& R, const Eigen::Vector3d& translation)
      : q_(Eigen::Quaterniond(R).normalized()), t_(translation) {}
  static SE3 from_matrix(const Eigen::Matrix4d& M) {
    return {Eigen::Matrix3d(M.topLeftCorner<3, 3>()), M.topRightCorner<3, 1>()};
  }
  static SE3 exp(const Vector6d& xi);

  Vector6d log() const;
  SE3 inverse() const;
  SE3 operator*(const SE3& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return q_ * p + t_; }

  const Eigen::Quaterniond& rotation() const { return q_; }
  const Eigen::Vector3d& translation() const { return t_; }
  Eigen::Matrix3d rotation_matrix() const { return q_.toRotationMatrix(); }
  Eigen::Matrix4d matrix() const;
  /// Ad with exp(Ad * xi) = T * exp(xi) * T^-1, twists as above.
  Matrix6d adjoint() const;
  /// Rotation angle in [0, pi] [rad].
  double angle() const { return so3_log(q_).norm(); }
  bool is_finite() const { return q_.coeffs().allFinite() && t_.allFinite(); }

 private:
  Eigen::Quaterniond q_;
  Eigen::Vector3d t_;
};

/// The motion a fraction s of the way from T_a to T_b: exp(s * log(T_b * T_a^-1)) * T_a. s outside 0..1 extrapolates.
SE3 interpolate(const SE3& T_a, const SE3& T_b, double s);

/// F T F with F = diag(1, -1, 1): the same motion where the y axis is inverted in both of its frames.
SE3 reflected(const SE3& T);

}  // namespace odosplat
