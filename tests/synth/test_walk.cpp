// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/walk.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/synth/motion/clearance.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat {
namespace {

const std::vector<Waypoint> square{{{1.0, 1.0, 1.2}, {2.0, 1.5, 1.0}},
                                   {{3.0, 1.0, 1.2}, {2.0, 1.5, 1.0}},
                                   {{3.0, 2.0, 1.4}, {2.0, 1.5, 1.0}},
                                   {{1.0, 2.0, 1.4}, {2.0, 1.5, 1.0}}};

WalkOptions options_of(int frames, double length_m, bool loop) {
  WalkOptions options;
  options.frames = frames;
  options.length_m = length_m;
  options.loop = loop;
  return options;
}

TEST(Walk, HasTheLengthThatIsAskedForTremorIncluded) {
  for (const double length : {2.0, 5.0, 20.0}) {
    const Walk walk(square, options_of(900, length, true));
    EXPECT_NEAR(travelled_length(walk.trajectory()), length, 1e-3);
  }
  EXPECT_GT(Walk(square, options_of(900, 20.0, true)).laps(), 2.0);
}

TEST(Walk, GoesThroughItsWaypoints) {
  WalkOptions options = options_of(2000, 15.0, true);
  options.tremor_m = 0.0;
  const Trajectory path = Walk(square, options).trajectory();
  for (const Waypoint& w : square) {
    double nearest = 1.0;
    for (const StampedPose& p : path) nearest = std::min(nearest, (p.T_world_camera.translation() - w.eye).norm());
    EXPECT_LT(nearest, 0.01);
  }
}

TEST(Walk, IsKnownBetweenFrames) {
  const Walk walk(square, options_of(300, 5.0, true));
  const Trajectory path = walk.trajectory();
  const Eigen::Vector3d between = walk.pose_at(100.5 / 30.0).translation();
  const Eigen::Vector3d mean = 0.5 * (path[100].T_world_camera.translation() + path[101].T_world_camera.translation());
  EXPECT_EQ(walk.pose_at(path[100].time).translation(), path[100].T_world_camera.translation());
  EXPECT_LT((between - mean).norm(), 1e-3);
}

TEST(Walk, QuickTurnsSlowTheFeet) {
  // The view turns to the opposite direction within 10 cm of the path.
  const std::vector<Waypoint> line{{{1.0, 1.0, 1.2}, {1.0, 4.0, 1.2}},
                                   {{2.0, 1.0, 1.2}, {2.0, 4.0, 1.2}},
                                   {{2.1, 1.0, 1.2}, {4.0, -1.5, 1.2}},
                                   {{3.1, 1.0, 1.2}, {3.1, -2.0, 1.2}}};
  WalkOptions options = options_of(300, 2.0, false);
  options.tremor_m = options.tremor_deg = 0.0;
  options.max_turn_deg = 10.0;
  const Trajectory path = Walk(line, options).trajectory();
  double straight = 0.0;
  double turning = 1.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double x = path[k].T_world_camera.translation().x();
    const double step = (path[k].T_world_camera.translation() - path[k - 1].T_world_camera.translation()).norm();
    if (x > 1.3 && x < 1.7) straight = std::max(straight, step);
    if (x > 2.02 && x < 2.08) turning = std::min(turning, step);
  }
  EXPECT_LT(turning, 0.5 * straight);
}

TEST(Walk, RefusesWhatCannotBe) {
  EXPECT_THROW(Walk(square, options_of(900, 50.0, false)), InputError);  // the waypoints' path is too short
  EXPECT_THROW(Walk(square, options_of(900, 0.01, true)), InputError);   // the tremor alone is longer
  EXPECT_THROW(Walk(square, options_of(60, 20.0, true)), InputError);    // too fast
  EXPECT_THROW(Walk({square[0]}, options_of(900, 1.0, false)), InputError);
}

TEST(Clearance, IsTheDistanceToTheNearestSurface) {
  const Scene room = make_box_room(1);  // a wall at x = 0, a box from x = 2.6, y = 1.9 to 3.2, 2.5, 0.9 m high
  Trajectory path;
  for (const double x : {1.0, 0.3, 2.0}) path.push_back({x, SE3(Eigen::Quaterniond::Identity(), {x, 1.0, 1.2}), ""});
  const Clearance wall = clearance(room, path);
  EXPECT_NEAR(wall.distance, 0.3, 1e-6);
  EXPECT_EQ(wall.frame, 1U);
  const Trajectory edge{{0.0, SE3(Eigen::Quaterniond::Identity(), {2.4, 1.7, 1.0}), ""}};
  EXPECT_NEAR(clearance(room, edge).distance, std::sqrt(0.04 + 0.04 + 0.01), 1e-5);
  EXPECT_DOUBLE_EQ(clearance(room, {}).distance, 0.5);
}

}  // namespace
}  // namespace odosplat
