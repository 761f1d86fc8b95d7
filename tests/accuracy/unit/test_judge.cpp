// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "odosplat/core/random.hpp"
#include "tests/accuracy/judge.hpp"

namespace odosplat::accuracy {
namespace {

SE3 shifted(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0)}; }

/// A run whose frame k has the position error errors[k] [m]; a negative value: lost.
Run run_with(const std::vector<double>& errors) {
  Run run;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    PlayedFrame frame;
    frame.time = 0.1 * static_cast<double>(k);
    frame.frame = k;
    frame.T_world_camera_true = shifted(static_cast<double>(k));
    if (errors[k] >= 0.0) {
      frame.result.status = TrackStatus::ok;
      frame.result.T_world_camera = shifted(static_cast<double>(k) + errors[k]);
      frame.result.covariance = Matrix6d::Identity() * 1e-4;
      run.trajectory.push_back({frame.time, frame.result.T_world_camera, ""});
    }
    run.frames.push_back(frame);
  }
  return run;
}

TEST(Judge, CountsErrorsAndLosses) {
  auto run = run_with({0.0, 0.03, -1.0, 0.04, 9.0});
  run.frames[4].blind = true;
  const Judged judged = judge(run);
  EXPECT_EQ(judged.frames, 4U);
  EXPECT_EQ(judged.lost, 1U);
  EXPECT_DOUBLE_EQ(judged.lost_share(), 0.25);
  EXPECT_NEAR(judged.ate_m.rmse, std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 3.0), 1e-12);
  EXPECT_NEAR(judged.live_ate_m.max, 0.04, 1e-12);
  EXPECT_NEAR(judge(run, 1, 2).ate_m.rmse, 0.03, 1e-12);
}

TEST(Judge, NothingPosedIsNoError) {
  const Judged judged = judge(run_with({-1.0, -1.0}));
  EXPECT_EQ(judged.lost, 2U);
  EXPECT_EQ(judged.ate_m.count, 0U);
}

TEST(NormalisedError, OfErrorsDrawnFromTheCovarianceIsChiSquared) {
  // A covariance with strong correlations, far from the origin.
  Matrix6d root = Matrix6d::Zero();
  Random random(7);
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) root(r, c) = (r < 3 ? 2e-3 : 1e-3) * random.normal();
    root(r, r) += r < 3 ? 4e-3 : 2e-3;
  }
  const Matrix6d covariance = root * root.transpose();
  const SE3 truth(so3_exp({0.3, -0.2, 0.9}), {3.0, -1.0, 2.0});
  double sum = 0.0;
  double squares = 0.0;
  constexpr int draws = 4000;
  for (int k = 0; k < draws; ++k) {
    Vector6d z;
    for (int i = 0; i < 6; ++i) z[i] = random.normal();
    const SE3 estimate = SE3::exp(root * z).inverse() * truth;  // truth = exp(xi) estimate
    const double nees = normalised_error_squared(estimate, truth, covariance);
    EXPECT_NEAR(nees, z.squaredNorm(), 1e-6 * (1.0 + z.squaredNorm()));
    sum += nees;
    squares += nees * nees;
  }
  const double mean = sum / draws;
  EXPECT_NEAR(mean, 6.0, 0.25);                           // tolerance: 4.5 standard deviations of the mean
  EXPECT_NEAR(squares / draws - mean * mean, 12.0, 2.0);  // variance of chi squared: twice the degrees of freedom
}

TEST(NormalisedError, IsInfiniteWithoutCovariance) {
  EXPECT_TRUE(std::isinf(normalised_error_squared(SE3(), SE3(), Matrix6d::Zero())));
}

TEST(Consistency, SplitsKeyframesAndLeavesOutTheGivenPose) {
  auto run = run_with({5.0, 0.01, 0.02, -1.0});
  run.frames[2].result.keyframe = true;
  const Consistency c = consistency(run);
  EXPECT_EQ(c.all.count, 2U);
  EXPECT_NEAR(c.between.mean, 1.0, 1e-9);
  EXPECT_NEAR(c.keyframes.mean, 4.0, 1e-9);
  EXPECT_EQ(c.below_median, 1.0);
  EXPECT_EQ(c.above_99, 0.0);
}

TEST(Recovery, CountsFramesUntilItStays) {
  RecoveryBars bars;
  bars.hold = 3;
  const auto run = run_with({0.0, -1.0, 0.5, 0.01, 0.01, 0.05, 0.01, 0.01, 0.01, 0.2});
  EXPECT_EQ(frames_until_recovered(run, 1, run.frames.size(), bars), 5);
  EXPECT_EQ(frames_until_recovered(run, 9, run.frames.size(), bars), -1);
  EXPECT_EQ(frames_until_recovered(run, 3, 5, bars), 0);  // hold is cut at the end of the range
  EXPECT_EQ(wrong_poses(run, 0, run.frames.size(), bars), 2);
  EXPECT_EQ(wrong_poses(run, 3, 9, bars), 0);
}

TEST(Recovery, HeedsTheTurn) {
  auto run = run_with({0.0, 0.0});
  run.frames[1].result.T_world_camera = shifted(1.0) * SE3(so3_exp({0.0, 0.1, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_EQ(frames_until_recovered(run, 1, 2, {}), -1);
  EXPECT_EQ(wrong_poses(run, 1, 2, {}), 1);
}

}  // namespace
}  // namespace odosplat::accuracy
