// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>

#include "odosplat/odometry/trajectory_record.hpp"

namespace odosplat {
namespace {

SE3 at(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)}; }

TEST(TrajectoryRecord, FramesMoveWithTheirKeyframe) {
  TrajectoryRecord record;
  EXPECT_EQ(record.add_keyframe(0.0, at(1.0)), 0);
  record.add_frame(0.1, 0, at(0.1));
  record.move_keyframe(0, at(2.0));
  const Trajectory trajectory = record.compose();
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_DOUBLE_EQ(trajectory[0].T_world_camera.translation().x(), 2.0);
  EXPECT_DOUBLE_EQ(trajectory[1].T_world_camera.translation().x(), 2.1);
}

TEST(TrajectoryRecord, ACorrectionIsSpreadOverTheFramesBetweenKeyframes) {
  TrajectoryRecord record;
  record.add_keyframe(0.0, at(0.0));
  for (int k = 1; k <= 4; ++k) record.add_frame(0.1 * k, 0, at(0.1 * k));
  EXPECT_EQ(record.add_keyframe(0.4, at(0.6)), 1);  // it was tracked at 0.4
  const Trajectory trajectory = record.compose();
  ASSERT_EQ(trajectory.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(trajectory[k].T_world_camera.translation().x(), 0.15 * static_cast<double>(k), 1e-12);
  }
}

TEST(TrajectoryRecord, AKeyframeMayComeAFewFramesLate) {
  TrajectoryRecord record;
  record.add_keyframe(0.0, at(0.0));
  for (int k = 1; k <= 5; ++k) record.add_frame(0.1 * k, 0, at(0.1 * k));
  EXPECT_EQ(record.add_keyframe(0.2, at(0.4)), 1);  // frames of 0.3 and later were still tracked against keyframe 0
  const Trajectory trajectory = record.compose();
  ASSERT_EQ(trajectory.size(), 6U);
  for (std::size_t k = 1; k < 6; ++k) EXPECT_GT(trajectory[k].time, trajectory[k - 1].time);
  EXPECT_NEAR(trajectory[1].T_world_camera.translation().x(), 0.2, 1e-12);
  EXPECT_NEAR(trajectory[2].T_world_camera.translation().x(), 0.4, 1e-12);
  // The later frames keep their poses relative to the keyframe's tracked position of 0.2.
  for (std::size_t k = 3; k < 6; ++k) {
    EXPECT_NEAR(trajectory[k].T_world_camera.translation().x(), 0.2 + 0.1 * static_cast<double>(k), 1e-12);
  }
  // They also follow its later corrections.
  record.move_keyframe(1, at(0.5));
  EXPECT_NEAR(record.compose()[5].T_world_camera.translation().x(), 0.8, 1e-12);
}

TEST(TrajectoryRecord, ACorrectionIsNotSpreadOverALoss) {
  TrajectoryRecord record;
  record.add_keyframe(0.0, at(0.0));
  record.add_frame(0.1, 0, at(0.1));
  record.add_frame(0.2, 0, at(0.2));
  record.add_frame(0.5, 0, at(0.7), true);  // relocalised at a wrong place
  record.add_frame(0.6, 0, at(0.8));
  EXPECT_EQ(record.add_keyframe(0.6, at(0.6)), 1);
  const Trajectory trajectory = record.compose();
  ASSERT_EQ(trajectory.size(), 5U);
  EXPECT_DOUBLE_EQ(trajectory[1].T_world_camera.translation().x(), 0.1);
  EXPECT_DOUBLE_EQ(trajectory[2].T_world_camera.translation().x(), 0.2);
  EXPECT_DOUBLE_EQ(trajectory[4].T_world_camera.translation().x(), 0.6);
}

TEST(TrajectoryRecord, WhatIsWithdrawnIsNotInTheTrajectory) {
  TrajectoryRecord record;
  record.add_keyframe(0.0, at(0.0));
  for (const double time : {0.1, 0.2, 0.3}) record.add_frame(time, 0, at(time));
  record.add_keyframe(0.3, at(0.3));
  record.withdraw(0.1);
  record.withdraw(0.3);
  record.withdraw(0.7);
  record.add_frame(0.4, 1, at(0.1));
  const Trajectory trajectory = record.compose();
  ASSERT_EQ(trajectory.size(), 3U);
  EXPECT_EQ(trajectory[0].time, 0.0);
  EXPECT_EQ(trajectory[1].time, 0.2);
  EXPECT_EQ(trajectory[2].time, 0.4);
  EXPECT_NEAR(trajectory[2].T_world_camera.translation().x(), 0.4, 1e-12);
}

// The same frames with and without forgetting: what is left agrees, and what is kept is bounded.
TEST(TrajectoryRecord, WhatIsForgottenDoesNotChangeTheRest) {
  TrajectoryRecord all;
  TrajectoryRecord bounded;
  const auto both = [&](auto work) {
    work(all);
    work(bounded);
  };
  both([](TrajectoryRecord& record) { record.add_keyframe(0.0, at(0.0)); });
  int keyframe = 0;
  for (int k = 1; k < 4000; ++k) {
    const double time = 0.1 * k;
    both([&](TrajectoryRecord& record) { record.add_frame(time, keyframe, at(0.01 * (k % 5))); });
    if (k % 5 == 0) {
      // A keyframe that comes two frames late, as in real time, and corrects the pose that tracking gave.
      both([&](TrajectoryRecord& record) {
        EXPECT_EQ(record.add_keyframe(0.1 * (k - 2), at(0.02 * k)), keyframe + 1);
        for (int id = std::max(0, keyframe - 5); id <= keyframe; ++id) record.move_keyframe(id, at(0.02 * id));
      });
      ++keyframe;
    }
    if (k % 100 == 0) bounded.forget(time - 20.0);
    EXPECT_EQ(bounded.keyframe_time(keyframe), all.keyframe_time(keyframe));
  }
  bounded.move_keyframe(0, at(99.0));  // forgotten: no frame belongs to it
  const Trajectory rest = bounded.compose();
  const Trajectory whole = all.compose();
  ASSERT_LT(rest.size(), 350U);
  ASSERT_GT(rest.size(), 190U);
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const StampedPose& same = whole[whole.size() - rest.size() + k];
    EXPECT_EQ(rest[k].time, same.time);
    EXPECT_EQ(rest[k].T_world_camera.translation().x(), same.T_world_camera.translation().x()) << rest[k].time;
  }
  EXPECT_LT(bounded.keyframe_times().size(), 140U);
  EXPECT_EQ(bounded.keyframe_times().back(), all.keyframe_times().back());
}

}  // namespace
}  // namespace odosplat
