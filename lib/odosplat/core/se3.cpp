// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/se3.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

// V of exp((rho, omega)) = (exp(omega), V rho): Barfoot 2017, State Estimation for Robotics, equation 7.37.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d W = skew(omega);
  if (angle < 1e-5) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * W +
         (angle - std::sin(angle)) / (a2 * angle) * W * W;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d M;
  M << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return M;
}

Eigen::Quaterniond rotation_from_text(const Eigen::Quaterniond& q) {
  // Not Eigen's norm(), which squares the values and would overflow for those beyond 1e150.
  const double length = q.coeffs().stableNorm();
  if (!(length >= 0.5 && length <= 2.0)) {
    throw InputError(formatted("the quaternion has length %.3g, must be near 1 (0.5..2)", length));
  }
  return q.normalized();
}

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& omega) {
  const double half = 0.5 * omega.norm();
  const double sinc = half < 1e-6 ? 0.5 - half * half / 12.0 : std::sin(half) / (2.0 * half);
  const Eigen::Vector3d v = sinc * omega;
  return Eigen::Quaterniond(std::cos(half), v.x(), v.y(), v.z()).normalized();
}

Eigen::Vector3d so3_log(const Eigen::Quaterniond& q) {
  // The two quaternions of a rotation differ by sign; w >= 0 gives the angle in [0, pi].
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const Eigen::Vector3d v = sign * q.vec();
  const double n = v.norm();
  if (n < 1e-9) return 2.0 * v;
  return 2.0 * std::atan2(n, w) / n * v;
}

SE3 SE3::exp(const Vector6d& xi) {
  const Eigen::Vector3d omega = xi.tail<3>();
  return {so3_exp(omega), left_jacobian(omega) * xi.head<3>()};
}

Vector6d SE3::log() const {
  Vector6d xi;
  const Eigen::Vector3d omega = so3_log(q_);
  xi.head<3>() = left_jacobian(omega).partialPivLu().solve(t_);
  xi.tail<3>() = omega;
  return xi;
}

SE3 SE3::inverse() const {
  const Eigen::Quaterniond q = q_.conjugate();
  return {q, -(q * t_)};
}

SE3 SE3::operator*(const SE3& other) const { return {q_ * other.q_, q_ * other.t_ + t_}; }

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = rotation_matrix();
  M.topRightCorner<3, 1>() = t_;
  return M;
}

Matrix6d SE3::adjoint() const {
  const Eigen::Matrix3d R = rotation_matrix();
  Matrix6d Ad = Matrix6d::Zero();
  Ad.topLeftCorner<3, 3>() = R;
  Ad.topRightCorner<3, 3>() = skew(t_) * R;
  Ad.bottomRightCorner<3, 3>() = R;
  return Ad;
}

SE3 interpolate(const SE3& T_a, const SE3& T_b, double s) { return SE3::exp(s * (T_b * T_a.inverse()).log()) * T_a; }

SE3 reflected(const SE3& T) {
  const Eigen::Quaterniond& q = T.rotation();
  const Eigen::Vector3d& t = T.translation();
  return {Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z()), Eigen::Vector3d(t.x(), -t.y(), t.z())};
}

}  // namespace odosplat
