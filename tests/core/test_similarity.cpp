// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/similarity.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

TEST(Similarity, MovesPosesAsItMovesPoints) {
  const SE3 T_b_a = SE3::exp((Vector6d() << 1, -2, 3, 0.5, 2.0, -1.0).finished());
  const Similarity S{0.4, T_b_a};
  const SE3 T_a_camera = SE3::exp((Vector6d() << 0.2, 0.7, -1.1, -0.3, 0.2, 0.9).finished());
  const Eigen::Vector3d p_camera(0.3, -0.2, 2.0);
  // A point at p_camera is seen in the moved pose in the same direction, at 0.4 times the distance.
  EXPECT_LT((S * (T_a_camera * p_camera) - (S * T_a_camera) * (0.4 * p_camera)).norm(), 1e-14);
}

TEST(AlignPoints, FindsTheSimilarityThatWasApplied) {
  Random random(1);
  const SE3 T = SE3::exp((Vector6d() << 1, -2, 3, 0.5, 2.0, -1.0).finished());
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
  for (int i = 0; i < 50; ++i) {
    source.emplace_back(random.normal(), random.normal(), random.normal());
    target.emplace_back(2.5 * (T.rotation() * source.back()) + T.translation());
  }
  const Similarity S = align_points(source, target, true);
  EXPECT_NEAR(S.scale, 2.5, 1e-12);
  EXPECT_LT((S.T_target_source.inverse() * T).log().norm(), 1e-12);
  EXPECT_EQ(align_points(source, target, false).scale, 1.0);
}

TEST(AlignPoints, IsTheBestRigidMotionEvenForMirroredPoints) {
  // A reflection would fit exactly; the result must be a rotation that no small motion improves.
  Random random(2);
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
  for (int i = 0; i < 30; ++i) {
    source.emplace_back(3.0 * random.normal(), random.normal(), 0.5 * random.normal());
    target.emplace_back(source.back().x(), source.back().y(), -source.back().z());
  }
  const auto cost = [&](const Similarity& S) {
    double sum = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i) sum += (S * source[i] - target[i]).squaredNorm();
    return sum;
  };
  const Similarity S = align_points(source, target, false);
  EXPECT_NEAR(S.T_target_source.rotation_matrix().determinant(), 1.0, 1e-12);
  for (int axis = 0; axis < 6; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      Similarity moved = S;
      moved.T_target_source = SE3::exp(step * Vector6d::Unit(axis)) * S.T_target_source;
      EXPECT_GT(cost(moved), cost(S));
    }
  }
}

TEST(AlignPoints, RefusesWhatLeavesTheRotationOpen) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 10; ++i) line.emplace_back(0.1 * i, 0.2 * i, 5.0);
  EXPECT_THROW(align_points(line, line, false), InputError);
  const std::vector<Eigen::Vector3d> place(10, Eigen::Vector3d(1, 2, 3));
  EXPECT_THROW(align_points(place, place, true), InputError);
  EXPECT_THROW(align_points({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, false), InputError);
}

}  // namespace
}  // namespace odosplat
