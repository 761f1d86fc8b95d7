// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/depth_elimination.hpp"

namespace odosplat {
namespace {

/// [m^2] information of an inverse depth below which it counts as unknown: a standard deviation of 30 /m.
constexpr double least_information = 1e-3;

Eigen::VectorXd inverse_of(const HostDepths& depths, double damping) {
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(depths.H.size());
  for (Eigen::Index i = 0; i < inverse.size(); ++i) {
    if (depths.H[i] > least_information) inverse[i] = 1.0 / (depths.H[i] * (1.0 + damping));
  }
  return inverse;
}

}  // namespace

void eliminate_depths(const HostDepths& depths, double damping, Eigen::MatrixXd& H, Eigen::VectorXd& g) {
  if (depths.points.empty()) return;
  const Eigen::Index rows = depths.cross.rows();
  const Eigen::VectorXd inverse = inverse_of(depths, damping);
  const Eigen::MatrixXd scaled = depths.cross * inverse.cwiseSqrt().asDiagonal();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(rows, rows);
  product.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
  H.topLeftCorner(rows, rows) -= Eigen::MatrixXd(product.selfadjointView<Eigen::Lower>());
  g.head(rows) -= depths.cross * inverse.cwiseProduct(depths.g);
}

Eigen::VectorXd depth_steps(const HostDepths& depths, double damping, const Eigen::VectorXd& step) {
  const Eigen::VectorXd along = depths.g + depths.cross.transpose() * step.head(depths.cross.rows());
  return -inverse_of(depths, damping).cwiseProduct(along);
}

}  // namespace odosplat
