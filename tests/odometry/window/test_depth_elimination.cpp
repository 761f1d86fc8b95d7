// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "odosplat/core/random.hpp"
#include "odosplat/odometry/window/depth_elimination.hpp"

namespace odosplat {
namespace {

/// Normal equations of random residuals with `keyframes` keyframe parameters and `points` offsets; each residual
/// depends on one offset.
struct Problem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  HostDepths depths;
};

Problem random_problem(Eigen::Index keyframes, Eigen::Index points) {
  Random random(7);
  const Eigen::Index size = keyframes + points;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6 * points, size);
  Eigen::VectorXd r(6 * points);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    for (Eigen::Index k = 0; k < keyframes; ++k) J(i, k) = random.uniform(-1.0, 1.0);
    J(i, keyframes + i % points) = random.uniform(0.5, 2.0);
    r[i] = random.uniform(-1.0, 1.0);
  }
  Problem p;
  p.H = J.transpose() * J;
  p.g = J.transpose() * r;
  p.depths.H = p.H.diagonal().tail(points);
  p.depths.g = p.g.tail(points);
  p.depths.cross = p.H.topRightCorner(keyframes, points);
  for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) p.depths.points.push_back(i);
  return p;
}

TEST(DepthElimination, StepIsThatOfTheDenseEquations) {
  for (const double damping : {0.0, 0.3}) {
    const Problem p = random_problem(16, 40);
    Eigen::MatrixXd whole = p.H;
    whole.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd expected = -whole.ldlt().solve(p.g);

    Eigen::MatrixXd H = whole.topLeftCorner(16, 16);
    Eigen::VectorXd g = p.g.head(16);
    eliminate_depths(p.depths, damping, H, g);
    const Eigen::VectorXd step = -H.ldlt().solve(g);
    EXPECT_LT((step - expected.head(16)).norm(), 1e-10);
    EXPECT_LT((depth_steps(p.depths, damping, step) - expected.tail(40)).norm(), 1e-10);
  }
}

TEST(DepthElimination, APointThatNothingIsKnownOfIsLeftAlone) {
  Problem p = random_problem(8, 10);
  Eigen::MatrixXd H = p.H.topLeftCorner(8, 8);
  Eigen::VectorXd g = p.g.head(8);
  p.depths.H[3] = 0.0;
  p.depths.cross.col(3).setZero();
  eliminate_depths(p.depths, 0.0, H, g);
  EXPECT_TRUE(H.allFinite());
  EXPECT_EQ(depth_steps(p.depths, 0.0, Eigen::VectorXd::Ones(8))[3], 0.0);
}

}  // namespace
}  // namespace odosplat
