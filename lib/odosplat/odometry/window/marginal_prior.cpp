// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/marginal_prior.hpp"

#include <Eigen/Dense>

namespace odosplat {

int MarginalPrior::find(const Keyframe* keyframe) const {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].keyframe.get() == keyframe) return static_cast<int>(i);
  }
  return -1;
}

Eigen::Matrix<double, 8, 1> marginal_deviation(const MarginalPrior::Frame& frame, const SE3& T_world_camera,
                                               const Brightness& brightness) {
  Eigen::Matrix<double, 8, 1> x;
  x << (T_world_camera * frame.T_linearised.inverse()).log(), brightness.a - frame.brightness.a,
      brightness.b - frame.brightness.b;
  return x;
}

void translate(MarginalPrior& prior, const Eigen::Vector3d& by) {
  // exp(xi) left of T is exp(Ad(S) xi) left of S T, S the translation.
  const Matrix6d back = SE3(Eigen::Quaterniond::Identity(), -by).adjoint();
  const auto n = static_cast<Eigen::Index>(prior.frames.size());
  for (MarginalPrior::Frame& frame : prior.frames) {
    frame.T_linearised = SE3(frame.T_linearised.rotation(), frame.T_linearised.translation() + by);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    prior.H.middleRows<6>(8 * i) = (back.transpose() * prior.H.middleRows<6>(8 * i)).eval();
    prior.g.segment<6>(8 * i) = (back.transpose() * prior.g.segment<6>(8 * i)).eval();
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    prior.H.middleCols<6>(8 * i) = (prior.H.middleCols<6>(8 * i) * back).eval();
  }
}

void marginalize(Eigen::MatrixXd& H, Eigen::VectorXd& g, const std::vector<Eigen::Index>& out) {
  const Eigen::Index size = H.rows();
  const auto m = static_cast<Eigen::Index>(out.size());
  std::vector<Eigen::Index> order;
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (next < out.size() && out[next] == i) {
      ++next;
    } else {
      order.push_back(i);
    }
  }
  order.insert(order.end(), out.begin(), out.end());
  const Eigen::MatrixXd ordered = H(order, order);
  const Eigen::VectorXd ordered_g = g(order);
  const Eigen::Index n = size - m;
  // Scaled to a unit diagonal, so that metres, radians and grey values are alike to the threshold.
  const Eigen::VectorXd scale = ordered.diagonal().tail(m).cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd block = scale.asDiagonal() * ordered.bottomRightCorner(m, m) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (block + block.transpose()));
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (eigen.eigenvalues()[i] > 1e-9) inverse[i] = 1.0 / eigen.eigenvalues()[i];
  }
  const Eigen::MatrixXd half = scale.asDiagonal() * eigen.eigenvectors() * inverse.cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd coupled = ordered.topRightCorner(n, m) * half;
  H = ordered.topLeftCorner(n, n) - coupled * coupled.transpose();
  H = (0.5 * (H + H.transpose())).eval();
  g = ordered_g.head(n) - coupled * (half.transpose() * ordered_g.tail(m));
}

}  // namespace odosplat
