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

TEST(MotionModel, VelocityFollowsAnEvenAcceleration) {
  // Turning and moving along one axis, so that the velocities of all times commute.
  const auto path = [](double t) {
    const double way = 0.4 * t + 1.5 * t * t;
    return SE3(so3_exp({0.0, 0.0, way}), {0.0, 0.0, 2.0 * way});
  };
  MotionHistory history;
  history.add(0.00, path(0.00));
  history.add(0.03, path(0.03));
  const Vector6d velocity = velocity_at(history, 0.08, path(0.08));
  const double speed = 0.4 + 3.0 * 0.08;
  Vector6d expected;
  expected << 0.0, 0.0, -2.0 * speed, 0.0, 0.0, -speed;
  EXPECT_LT((velocity - expected).norm(), 1e-9);
  EXPECT_GT((velocity_to(history, 0.08, path(0.08)) - expected).norm(), 0.1);
}

}  // namespace
}  // namespace odosplat
