// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace odosplat {

/// The estimated offsets of one keyframe's points in a window's normal equations. Each stands in its own row and is
/// coupled to keyframes only, never to another offset: they can be eliminated one by one.
struct HostDepths {
  std::vector<std::size_t> points;  // indices into the keyframe's points
  Eigen::VectorXd H;                // own entry, a point each
  Eigen::VectorXd g;
  Eigen::MatrixXd cross;  // a column a point, as many rows as the window has parameters of keyframes
};

/// Factor 1 + damping of own entries, as Levenberg and Marquardt have it. Points of no information are left out.
/// Takes sum cross cross^T / H off H's top left corner and sum cross g / H off g's head (Schur complement).
void eliminate_depths(const HostDepths& depths, double damping, Eigen::MatrixXd& H, Eigen::VectorXd& g);

/// The offsets' steps [1/m] that belong to the keyframes' step: -(g + cross^T step) / H.
Eigen::VectorXd depth_steps(const HostDepths& depths, double damping, const Eigen::VectorXd& step);

}  // namespace odosplat
