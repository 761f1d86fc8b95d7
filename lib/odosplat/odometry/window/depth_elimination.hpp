// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace odosplat {

/// The estimated offsets of one keyframe's points in a window's normal equations. Each has its own row and is coupled
/// with keyframes only, never with another offset: they can be eliminated one by one.
struct HostDepths {
  std::vector<std::size_t> points;  // indices into the keyframe's points
  Eigen::VectorXd H;                // diagonal entry of each point
  Eigen::VectorXd g;
  Eigen::MatrixXd cross;  // a column for each point, with as many rows as the window has parameters of keyframes
};

/// Subtracts sum cross cross^T / H from H's top left corner and sum cross g / H from g's head (Schur complement). The
/// offsets' diagonal entries are multiplied by 1 + damping (Levenberg-Marquardt). Points without information are left
/// out.
void eliminate_depths(const HostDepths& depths, double damping, Eigen::MatrixXd& H, Eigen::VectorXd& g);

/// The offsets' steps [1/m] that belong to the keyframes' step: -(g + cross^T step) / H.
Eigen::VectorXd depth_steps(const HostDepths& depths, double damping, const Eigen::VectorXd& step);

}  // namespace odosplat
