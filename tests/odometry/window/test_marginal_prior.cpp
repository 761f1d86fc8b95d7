// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "odosplat/core/random.hpp"
#include "odosplat/odometry/window/marginal_prior.hpp"

namespace odosplat {
namespace {

Eigen::MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index cols) {
  Eigen::MatrixXd M(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index k = 0; k < cols; ++k) M(i, k) = random.uniform(-1.0, 1.0);
  }
  return M;
}

TEST(MarginalPrior, WhatStaysHasTheOptimumOfTheWholeLinearProblem) {
  Random random(3);
  const Eigen::MatrixXd J = random_matrix(random, 60, 20);
  const Eigen::VectorXd r = random_matrix(random, 60, 1);
  Eigen::MatrixXd H = J.transpose() * J;
  Eigen::VectorXd g = J.transpose() * r;
  const Eigen::VectorXd optimum = -H.ldlt().solve(g);
  const Eigen::MatrixXd covariance = H.inverse();
  const std::vector<Eigen::Index> out{2, 3, 4, 11, 19};
  std::vector<Eigen::Index> stay;
  for (Eigen::Index i = 0; i < 20; ++i) {
    if (std::find(out.begin(), out.end(), i) == out.end()) stay.push_back(i);
  }
  marginalize(H, g, out);
  ASSERT_EQ(H.rows(), 15);
  EXPECT_LT((-H.ldlt().solve(g) - optimum(stay)).norm(), 1e-9);
  EXPECT_LT((H.inverse() - covariance(stay, stay)).norm(), 1e-9);
}

TEST(MarginalPrior, DirectionsWithoutInformationTakeNothingAway) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(4, 4);
  H.topLeftCorner<2, 2>() << 2.0, 0.5, 0.5, 1.0;
  Eigen::VectorXd g(4);
  g << 1.0, -1.0, 0.0, 0.0;
  const Eigen::MatrixXd before = H.topLeftCorner(2, 2);
  marginalize(H, g, {2, 3});
  EXPECT_EQ(H, before);
  EXPECT_EQ(g, Eigen::Vector2d(1.0, -1.0));
}

TEST(MarginalPrior, MovingTheWorldsOriginLeavesItsCost) {
  Random random(5);
  MarginalPrior prior;
  std::vector<SE3> poses;
  for (int i = 0; i < 2; ++i) {
    const SE3 T(so3_exp({0.1 * i, 0.2, -0.1}), Eigen::Vector3d(1.0 + i, 2.0, -0.5));
    prior.frames.push_back({std::make_shared<Keyframe>(), T, {0.1, 0.02}});
    Vector6d xi;
    xi << 0.01, -0.02, 0.01, 0.003, 0.001, -0.002;
    poses.push_back(SE3::exp(xi) * T);
  }
  const Eigen::MatrixXd J = random_matrix(random, 30, 16);
  prior.H = J.transpose() * J;
  prior.g = random_matrix(random, 16, 1);
  const auto cost = [](const MarginalPrior& p, const std::vector<SE3>& T) {
    Eigen::VectorXd x(16);
    for (Eigen::Index i = 0; i < 2; ++i) {
      const auto k = static_cast<std::size_t>(i);
      x.segment<8>(8 * i) = marginal_deviation(p.frames[k], T[k], {0.15, 0.03});
    }
    return p.g.dot(x) + 0.5 * x.dot(p.H * x);
  };
  const double before = cost(prior, poses);
  const Eigen::Vector3d by(40.0, -30.0, 10.0);
  translate(prior, by);
  for (SE3& T : poses) T = SE3(T.rotation(), T.translation() + by);
  EXPECT_NEAR(cost(prior, poses), before, 1e-9 * std::abs(before));
}

}  // namespace
}  // namespace odosplat
