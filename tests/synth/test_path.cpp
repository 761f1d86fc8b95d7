// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const std::vector<Waypoint> square{{{0.0, 0.0, 1.5}, {3.0, 3.0, 1.0}},
                                   {{1.0, 0.0, 1.4}, {1.0, 3.0, 1.0}},
                                   {{1.0, 1.0, 1.6}, {0.0, 3.0, 1.2}},
                                   {{0.0, 1.0, 1.5}, {1.0, 3.0, 1.2}}};

TEST(LookAt, PutsTheTargetOnTheAxisAndTheHorizonLevel) {
  const Eigen::Vector3d eye(1.0, -2.0, 1.5);
  const Eigen::Vector3d target(-0.5, 0.7, 0.4);
  const SE3 T_world_camera = look_at(eye, target);
  const Eigen::Vector3d seen = T_world_camera.inverse() * target;
  EXPECT_NEAR(seen.x(), 0.0, 1e-12);
  EXPECT_NEAR(seen.y(), 0.0, 1e-12);
  EXPECT_NEAR(seen.z(), (target - eye).norm(), 1e-12);
  EXPECT_NEAR(T_world_camera.rotation_matrix()(2, 0), 0.0, 1e-12);  // x axis level
  EXPECT_LT(T_world_camera.rotation_matrix()(2, 1), 0.0);           // y axis down
  EXPECT_THROW(look_at(eye, eye), InputError);
  EXPECT_THROW(look_at(eye, eye + Eigen::Vector3d::UnitZ()), InputError);
}

TEST(HandHeldPath, GoesThroughItsWaypointsWithoutTremor) {
  PathOptions options;
  options.frames = 400;
  options.tremor_m = 0.0;
  options.tremor_rad = 0.0;
  const Trajectory path = hand_held_path(square, options);
  ASSERT_EQ(path.size(), 400U);
  for (const Waypoint& w : square) {
    double nearest = 1e9;
    for (const StampedPose& p : path) {
      nearest = std::min(
          nearest, (p.T_world_camera.translation() - w.eye).norm() +
                       so3_log(look_at(w.eye, w.target).rotation().conjugate() * p.T_world_camera.rotation()).norm());
    }
    EXPECT_LT(nearest, 0.015);  // frames are up to 1 cm apart
  }
  EXPECT_LT((path.front().T_world_camera.translation() - square.front().eye).norm(), 1e-9);
  EXPECT_LT((path.back().T_world_camera.translation() - square.back().eye).norm(), 1e-9);
}

TEST(HandHeldPath, IsSmoothAndKeepsItsBounds) {
  PathOptions options;
  options.max_speed = 0.8;
  options.max_turn = 1.2;
  const Trajectory path = hand_held_path(square, options);
  double speed = 0.0;
  double turn = 0.0;
  double jerk = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    EXPECT_DOUBLE_EQ(path[k].time, static_cast<double>(k) / 30.0);
    const SE3 step = path[k - 1].T_world_camera.inverse() * path[k].T_world_camera;
    speed = std::max(speed, step.translation().norm() * 30.0);
    turn = std::max(turn, step.angle() * 30.0);
    if (k > 1) {
      const Eigen::Vector3d second = path[k].T_world_camera.translation() -
                                     2.0 * path[k - 1].T_world_camera.translation() +
                                     path[k - 2].T_world_camera.translation();
      jerk = std::max(jerk, second.norm());
    }
  }
  EXPECT_LE(speed, 0.8);
  EXPECT_LE(turn, 1.2);
  EXPECT_GT(speed, 0.2);
  EXPECT_LT(jerk, 0.01);  // [m per frame squared]: no jumps
}

TEST(HandHeldPath, TremorHasTheAskedSize) {
  PathOptions options;
  options.frames = 2000;
  options.tremor_m = 0.01;
  options.tremor_rad = 0.02;
  options.max_speed = 3.0;
  options.max_turn = 5.0;
  const Trajectory shaken = hand_held_path(square, options);
  options.tremor_m = 0.0;
  options.tremor_rad = 0.0;
  const Trajectory steady = hand_held_path(square, options);
  double position = 0.0;
  double rotation = 0.0;
  for (std::size_t k = 0; k < shaken.size(); ++k) {
    const SE3& T_world_shaken = shaken[k].T_world_camera;
    const SE3& T_world_steady = steady[k].T_world_camera;
    position += (T_world_shaken.translation() - T_world_steady.translation()).squaredNorm() / 3.0;
    rotation += so3_log(T_world_steady.rotation().conjugate() * T_world_shaken.rotation()).squaredNorm() / 3.0;
  }
  EXPECT_NEAR(std::sqrt(position / 2000.0), 0.01, 0.002);
  // The tremor of the position also rotates the view of the target, by about 0.01 m / 3 m.
  EXPECT_NEAR(std::sqrt(rotation / 2000.0), 0.02, 0.004);
}

TEST(HandHeldPath, ClosedPathEndsOneFrameBeforeItsStart) {
  PathOptions options;
  options.closed = true;
  options.frames = 300;
  const Trajectory path = hand_held_path(square, options);
  const SE3 gap = path.back().T_world_camera.inverse() * path.front().T_world_camera;
  EXPECT_LT(gap.translation().norm(), options.max_speed / 30.0);
  EXPECT_LT(gap.angle(), options.max_turn / 30.0);
}

TEST(HandHeldPath, SameSeedSameBitsOtherSeedOtherPath) {
  PathOptions options;
  const Trajectory a = hand_held_path(square, options);
  const Trajectory b = hand_held_path(square, options);
  options.seed = 2;
  const Trajectory c = hand_held_path(square, options);
  double other = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].T_world_camera.matrix(), b[k].T_world_camera.matrix());
    other = std::max(other, (a[k].T_world_camera.translation() - c[k].T_world_camera.translation()).norm());
  }
  EXPECT_GT(other, 0.001);
}

TEST(HandHeldPath, TooFewFramesAreRefusedWithTheNumberNeeded) {
  PathOptions options;
  options.frames = 20;
  try {
    hand_held_path(square, options);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("needs about"), std::string::npos);
  }
  EXPECT_THROW(hand_held_path({square[0]}, PathOptions{}), InputError);
  options.frames = 1;
  EXPECT_THROW(hand_held_path(square, options), InputError);
}

}  // namespace
}  // namespace odosplat
