// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat {
namespace {

Vector6d random_twist(Random& random, double size) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-size, size);
  return xi;
}

double distance(const SE3& a, const SE3& b) { return (a.matrix() - b.matrix()).norm(); }

TEST(SE3, ExpAndLogAreInverse) {
  Random random(1);
  for (const double size : {0.0, 1e-12, 1e-7, 1e-5, 1e-3, 0.1, 1.0, 1.7}) {
    for (int i = 0; i < 20; ++i) {
      const Vector6d xi = random_twist(random, size);
      EXPECT_LT((SE3::exp(xi).log() - xi).norm(), 1e-9 * (1.0 + size)) << "size " << size;
    }
  }
}

TEST(SE3, ExpSolvesItsDifferentialEquation) {
  // exp(xi) = (exp(xi / n))^n: for small steps no closed form of the left Jacobian is needed.
  Random random(2);
  const Vector6d xi = random_twist(random, 1.0);
  const int n = 1 << 20;
  SE3 T = SE3::exp(xi / n);
  for (int k = 0; k < 20; ++k) T = T * T;
  EXPECT_LT(distance(T, SE3::exp(xi)), 1e-6);
}

TEST(SE3, RotationByPiHasALog) {
  const SE3 T = SE3::exp((Vector6d() << 0, 0, 0, 0, std::numbers::pi, 0).finished());
  EXPECT_NEAR(T.angle(), std::numbers::pi, 1e-9);
  EXPECT_LT(distance(SE3::exp(T.log()), T), 1e-9);
}

TEST(SE3, InverseAndCompositionAgreeWithMatrices) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const SE3 T_a_b = SE3::exp(random_twist(random, 2.0));
    const SE3 T_b_c = SE3::exp(random_twist(random, 2.0));
    EXPECT_LT(((T_a_b * T_b_c).matrix() - T_a_b.matrix() * T_b_c.matrix()).norm(), 1e-12);
    EXPECT_LT(distance(T_a_b * T_a_b.inverse(), SE3()), 1e-12);
  }
}

TEST(SE3, AdjointMovesATwistThroughAPose) {
  Random random(4);
  const SE3 T = SE3::exp(random_twist(random, 1.0));
  const Vector6d xi = random_twist(random, 0.5);
  EXPECT_LT(distance(SE3::exp(T.adjoint() * xi), T * SE3::exp(xi) * T.inverse()), 1e-12);
}

TEST(SE3, OneRuleForQuaternionsThatAreWritten) {
  for (const double length : {0.5, 0.99, 1.0, 2.0}) {
    const Eigen::Quaterniond q = rotation_from_text(Eigen::Quaterniond(0.6 * length, 0.0, 0.8 * length, 0.0));
    EXPECT_NEAR(q.w(), 0.6, 1e-12);
    EXPECT_NEAR(q.y(), 0.8, 1e-12);
  }
  for (const double length : {0.0, 1e-300, 0.49, 2.01, 1e200, std::nan("")}) {
    EXPECT_THROW(rotation_from_text(Eigen::Quaterniond(length, 0.0, 0.0, 0.0)), InputError) << length;
  }
}

TEST(SE3, InterpolationMeetsItsEnds) {
  Random random(5);
  const SE3 T_a = SE3::exp(random_twist(random, 1.0));
  const SE3 T_b = SE3::exp(random_twist(random, 1.0));
  EXPECT_LT(distance(interpolate(T_a, T_b, 0.0), T_a), 1e-12);
  EXPECT_LT(distance(interpolate(T_a, T_b, 1.0), T_b), 1e-12);
  const SE3 half = interpolate(T_a, T_b, 0.5);
  EXPECT_LT(distance(half * T_a.inverse(), T_b * half.inverse()), 1e-9);
}

TEST(SE3, ReflectionInvertsTheYAxisOfBothFrames) {
  Random random(7);
  const SE3 T = SE3::exp(random_twist(random, 1.0));
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F(1, 1) = -1.0;
  EXPECT_LT((reflected(T).matrix() - F * T.matrix() * F).norm(), 1e-12);
}

TEST(StampedPose, PoseBetweenTwoGoesOnBeyondThem) {
  Random random(6);
  const StampedPose before{2.0, SE3::exp(random_twist(random, 0.5)), ""};
  const StampedPose after{2.5, SE3::exp(random_twist(random, 0.5)), ""};
  EXPECT_LT(distance(pose_between(before, after, 2.0), before.T_world_camera), 1e-12);
  EXPECT_LT(distance(pose_between(before, after, 2.5), after.T_world_camera), 1e-12);
  const SE3 motion = after.T_world_camera * before.T_world_camera.inverse();
  EXPECT_LT(distance(pose_between(before, after, 3.0), motion * after.T_world_camera), 1e-9);
}

}  // namespace
}  // namespace odosplat
