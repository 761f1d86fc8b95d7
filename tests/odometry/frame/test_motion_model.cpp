// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/motion_model.hpp"

#include <gtest/gtest.h>

#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

TEST(MotionModel, VelocityLeadsFromTheLastPoseToThisOne) {
  MotionHistory history;
  history.add(1.0, test::room_path(10));
  const SE3 T_world_camera = test::room_path(13);
  const Vector6d velocity = velocity_to(history, 1.1, T_world_camera);
  const SE3 T_camera_world = SE3::exp(0.1 * velocity) * test::room_path(10).inverse();
  EXPECT_LT((T_camera_world.matrix() - T_world_camera.inverse().matrix()).norm(), 1e-12);
  EXPECT_GT(velocity.norm(), 0.1);
}

}  // namespace
}  // namespace odosplat
