// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/evaluate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/eval/evo_figures.hpp"
#include "tests/eval/read_poses.hpp"
#include "tests/locations.hpp"

namespace odosplat {
namespace {

Trajectory at_times(const std::vector<double>& times) {
  Trajectory trajectory;
  for (const double t : times) trajectory.push_back({t, SE3(), ""});
  return trajectory;
}

// A path with curves in all directions, 30 poses per second.
Trajectory path(int n) {
  Trajectory trajectory;
  for (int i = 0; i < n; ++i) {
    const double t = i / 30.0;
    const Vector6d xi =
        (Vector6d() << std::sin(t), std::cos(1.3 * t), 0.4 * t, 0.2 * std::sin(2 * t), 0.3 * t, 0.1).finished();
    trajectory.push_back({t, SE3::exp(xi), ""});
  }
  return trajectory;
}

EvalOptions with(TrajectoryAlignment alignment) {
  EvalOptions options;
  options.alignment = alignment;
  return options;
}

TEST(Percentile, InterpolatesBetweenNeighbors) {
  const std::vector<double> v{1.0, 2.0, 4.0, 8.0, 16.0};
  EXPECT_DOUBLE_EQ(percentile(v, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile(v, 100.0), 16.0);
  EXPECT_DOUBLE_EQ(percentile(v, 50.0), 4.0);
  EXPECT_DOUBLE_EQ(percentile(v, 90.0), 8.0 + 0.6 * 8.0);  // at position 3.6 of 0..4
  EXPECT_DOUBLE_EQ(percentile({}, 50.0), 0.0);
}

TEST(Statistics, ByHand) {
  const Statistics s = statistics({3.0, 1.0, 2.0, 6.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(50.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.standard_deviation, std::sqrt((0.0 + 4.0 + 1.0 + 9.0) / 4.0));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 6.0);
  EXPECT_DOUBLE_EQ(s.p99, 3.0 + 0.97 * 3.0);
  EXPECT_EQ(statistics({}).count, 0U);
}

TEST(Associate, TakesTheNearestWithinTheTolerance) {
  using testing::ElementsAre;
  EXPECT_THAT(associate(at_times({0.0, 1.0, 2.0}), at_times({0.004, 0.009, 1.02, 1.995}), 0.01),
              ElementsAre(Match{0, 0}, Match{2, 3}));
  EXPECT_THAT(associate(at_times({0.0, 0.1, 0.2, 0.3}), at_times({0.1, 0.3}), 0.01),
              ElementsAre(Match{1, 0}, Match{3, 1}));
  EXPECT_THAT(associate(at_times({0.5}), at_times({0.0, 1.0}), 0.5), ElementsAre(Match{0, 0})) << "the earlier of two";
  EXPECT_TRUE(associate(at_times({}), at_times({1.0}), 0.01).empty());
  EXPECT_TRUE(associate(at_times({1.0}), at_times({}), 0.01).empty());
}

TEST(Associate, GivesEachPoseToOneOther) {
  EXPECT_THAT(associate(at_times({0.0, 0.004, 1.0}), at_times({0.003, 1.0, 2.0, 3.0}), 0.01),
              testing::ElementsAre(Match{1, 0}, Match{2, 1}));
}

TEST(Associate, RefusesTimesOutOfOrder) {
  EXPECT_THROW(associate(at_times({1.0, 0.5}), at_times({1.0}), 0.01), InputError);
  EXPECT_THROW(associate(at_times({1.0}), at_times({std::nan("")}), 0.01), InputError);
}

TEST(ExpectedFrames, CountTheImagesACameraWouldHaveTaken) {
  const Trajectory truth = path(300);
  EXPECT_EQ(expected_frames(truth, truth), 300U);
  Trajectory with_gaps = truth;
  with_gaps.erase(with_gaps.begin() + 100, with_gaps.begin() + 200);
  EXPECT_EQ(expected_frames(with_gaps, truth), 300U);
  Trajectory fast;  // motion capture at 120 Hz for the same ten seconds
  for (int i = 0; i < 1197; ++i) fast.push_back({i / 120.0, SE3(), ""});
  EXPECT_EQ(expected_frames(truth, fast), 300U);
  EXPECT_EQ(expected_frames({}, truth), 300U);
}

TEST(Evaluate, TheTruthItselfHasNoError) {
  for (const TrajectoryAlignment alignment :
       {TrajectoryAlignment::none, TrajectoryAlignment::se3, TrajectoryAlignment::sim3}) {
    const EvalResult r = evaluate(path(100), path(100), with(alignment));
    EXPECT_LT(r.ate_m.max, 1e-12);
    EXPECT_LT(r.rte_m.max, 1e-12);
    EXPECT_LT(r.rre_deg.max, 1e-6);
    EXPECT_EQ(r.pairs, 100U);
    EXPECT_DOUBLE_EQ(r.coverage, 1.0);
    EXPECT_NEAR(r.truth_from_estimate.scale, 1.0, 1e-12);
  }
}

TEST(Evaluate, AConstantOffsetIsAbsoluteErrorUntilAligned) {
  const SE3 T_wrong_world = SE3::exp((Vector6d() << 0.3, 0.0, 0.4, 0, 0, 0).finished());
  Trajectory estimate = path(100);
  for (StampedPose& pose : estimate) pose.T_world_camera = T_wrong_world * pose.T_world_camera;
  const EvalResult none = evaluate(estimate, path(100), {});
  EXPECT_NEAR(none.ate_m.rmse, 0.5, 1e-12);
  EXPECT_NEAR(none.ate_m.standard_deviation, 0.0, 1e-12);
  EXPECT_LT(none.rte_m.max, 1e-12);
  EXPECT_LT(evaluate(estimate, path(100), with(TrajectoryAlignment::se3)).ate_m.max, 1e-12);
}

TEST(Evaluate, Sim3FindsTheScale) {
  Trajectory estimate = path(100);
  for (StampedPose& pose : estimate) {
    pose.T_world_camera = SE3(pose.T_world_camera.rotation(), 0.25 * pose.T_world_camera.translation());
  }
  const EvalResult r = evaluate(estimate, path(100), with(TrajectoryAlignment::sim3));
  EXPECT_NEAR(r.truth_from_estimate.scale, 4.0, 1e-9);
  EXPECT_LT(r.ate_m.max, 1e-9);
  EXPECT_LT(r.rte_m.max, 1e-9);
}

TEST(Evaluate, RelativeErrorsOfASingleJumpByHand) {
  // Twelve poses one metre apart; the second half is turned by 90 degrees and moved sideways by 2 m.
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i < 12; ++i) {
    truth.push_back({0.1 * i, SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(i, 0, 0)), ""});
    estimate.push_back(truth.back());
    if (i < 6) continue;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
    estimate.back().T_world_camera = SE3(turn, Eigen::Vector3d(5, 2, 0) + turn * Eigen::Vector3d(i - 5, 0, 0));
  }
  EvalOptions options;
  EvalResult r = evaluate(estimate, truth, options);
  EXPECT_EQ(r.rte_m.count, 11U);
  EXPECT_NEAR(r.rte_m.max, std::hypot(1.0, 3.0), 1e-12);  // the step is (5, 3) instead of (6, 0)
  EXPECT_NEAR(r.rre_deg.max, 90.0, 1e-9);
  EXPECT_NEAR(r.rre_deg.rmse, 90.0 / std::sqrt(11.0), 1e-9);
  options.delta = 4;
  r = evaluate(estimate, truth, options);
  EXPECT_EQ(r.rte_m.count, 2U);  // steps 0-4 and 4-8
  EXPECT_NEAR(r.rre_deg.mean, 45.0, 1e-9);
  options.all_pairs = true;
  r = evaluate(estimate, truth, options);
  EXPECT_EQ(r.rte_m.count, 8U);
  EXPECT_NEAR(r.rre_deg.mean, 90.0 * 4 / 8, 1e-9);
  options.delta = 12;
  EXPECT_EQ(evaluate(estimate, truth, options).rte_m.count, 0U);
}

TEST(Evaluate, CoverageCountsTheFramesWithoutEstimate) {
  Trajectory estimate = path(100);
  estimate.erase(estimate.begin() + 10, estimate.begin() + 35);
  EXPECT_DOUBLE_EQ(evaluate(estimate, path(100), {}).coverage, 0.75);
  EvalOptions options;
  options.frames = 150;
  EXPECT_DOUBLE_EQ(evaluate(estimate, path(100), options).coverage, 0.5);
}

TEST(Evaluate, CoverageCountsAgainstBoth) {
  Trajectory estimate = path(100);
  estimate.resize(80);
  Trajectory truth = path(100);
  truth.erase(truth.begin(), truth.begin() + 20);
  const EvalResult r = evaluate(estimate, truth, {});
  EXPECT_EQ(r.pairs, 60U);
  EXPECT_DOUBLE_EQ(r.coverage_estimate, 0.75);
  EXPECT_DOUBLE_EQ(r.coverage_truth, 0.75);
  EXPECT_DOUBLE_EQ(r.coverage, 0.75);
  EXPECT_EQ(r.doubt, "");
  truth.resize(70);
  EXPECT_DOUBLE_EQ(evaluate(estimate, truth, {}).coverage_truth, 60.0 / 70.0);
  EXPECT_DOUBLE_EQ(evaluate(estimate, truth, {}).coverage, 0.75);
  estimate.resize(30);
  EXPECT_DOUBLE_EQ(evaluate(estimate, truth, {}).coverage, 10.0 / 70.0);
}

// If only few poses are matched, the result names the reason.
TEST(Evaluate, SaysWhyUnderHalfIsMatched) {
  const struct {
    double factor;
    const char* unit;
  } units[] = {{1e3, "ms"}, {1e6, "us"}, {1e9, "ns"}};
  for (const auto& [factor, unit] : units) {
    for (const bool scale_truth : {false, true}) {
      Trajectory estimate = path(100);
      Trajectory truth = path(100);
      for (StampedPose& pose : scale_truth ? truth : estimate) pose.time *= factor;
      const EvalResult r = evaluate(estimate, truth, {});
      EXPECT_LE(r.pairs, 4U);
      EXPECT_LE(r.coverage, 0.04);
      EXPECT_LE(r.coverage_truth, 0.04);
      EXPECT_THAT(r.doubt, testing::HasSubstr("of 100 poses of the estimate match one of the truth in time (100)"));
      EXPECT_THAT(r.doubt, testing::EndsWith(std::string("the stamps of the ") + (scale_truth ? "truth" : "estimate") +
                                             " look like " + unit));
    }
  }
  Trajectory few = path(100);
  few.resize(40);
  const EvalResult r = evaluate(path(100), few, {});
  EXPECT_EQ(r.pairs, 40U);
  EXPECT_DOUBLE_EQ(r.coverage, 0.4);
  EXPECT_THAT(r.doubt, testing::EndsWith("the truth has few poses (40)"));
  few.resize(10);
  few.insert(few.end(), 60, StampedPose{500.0, SE3(), ""});
  EXPECT_THAT(evaluate(few, path(100), {}).doubt, testing::HasSubstr("10 of 70 poses of the estimate"));
}

TEST(Evaluate, NothingMatchedIsToldFromBadInput) {
  Trajectory late = path(100);
  for (StampedPose& pose : late) pose.time += 1000.0;
  try {
    evaluate(late, path(100), {});
    ADD_FAILURE() << "matched";
  } catch (const NothingMatched& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("a constant offset of about 1000.000 s"));
  }
  Trajectory nanoseconds = path(100);
  for (StampedPose& pose : nanoseconds) pose.time *= 1e9;
  EXPECT_THROW(evaluate(nanoseconds, path(100), with(TrajectoryAlignment::sim3)), NothingMatched);
}

TEST(Evaluate, BadInputIsNamed) {
  Trajectory late = path(10);
  for (StampedPose& pose : late) pose.time += 100.0;
  EXPECT_THROW(evaluate(late, path(10), {}), InputError);
  EXPECT_THROW(evaluate({}, path(10), {}), InputError);
  EXPECT_THROW(evaluate(path(2), path(10), with(TrajectoryAlignment::se3)), InputError);
  Trajectory bad = path(10);
  bad[3].T_world_camera = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, std::nan(""), 0));
  EXPECT_THROW(evaluate(bad, path(10), {}), InputError);
  EvalOptions options;
  options.delta = 0;
  EXPECT_THROW(evaluate(path(10), path(10), options), InputError);
  EXPECT_THROW(alignment_from_name("sim2"), InputError);
  EXPECT_EQ(alignment_from_name("sim3"), TrajectoryAlignment::sim3);
}

void expect_equal(const Statistics& ours, const EvoStatistics& evo) {
  EXPECT_NEAR(ours.rmse, evo.rmse, 1e-6);
  EXPECT_NEAR(ours.mean, evo.mean, 1e-6);
  EXPECT_NEAR(ours.median, evo.median, 1e-6);
  EXPECT_NEAR(ours.max, evo.max, 1e-6);
  EXPECT_NEAR(ours.p99, evo.p99, 1e-6);
}

TEST(Evaluate, EqualsTheRecordedFiguresOfEvo) {
  const std::string folder = test::shared_data() + "/evo/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the trajectories are not at " << folder;
  std::string read_truth;
  std::string read_estimate;
  Trajectory truth;
  Trajectory estimate;
  for (const EvoFigures& evo : evo_figures) {
    SCOPED_TRACE(std::string(evo.estimate) + " " + evo.alignment + " delta " + std::to_string(evo.delta));
    if (read_truth != evo.truth) truth = read_poses(folder + evo.truth);
    if (read_estimate != evo.estimate) estimate = read_poses(folder + evo.estimate);
    read_truth = evo.truth;
    read_estimate = evo.estimate;
    EvalOptions options;
    options.alignment = alignment_from_name(evo.alignment);
    options.delta = evo.delta;
    options.all_pairs = evo.all_pairs;
    const EvalResult r = evaluate(estimate, truth, options);
    EXPECT_EQ(r.pairs, evo.pairs);
    EXPECT_NEAR(r.truth_from_estimate.scale, evo.scale, 1e-6);
    expect_equal(r.ate_m, evo.ate_m);
    expect_equal(r.rte_m, evo.rte_m);
    expect_equal(r.rre_deg, evo.rre_deg);
  }
}

}  // namespace
}  // namespace odosplat
