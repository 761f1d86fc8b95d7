// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Keyframes made on the background thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "odosplat/odometry/keyframe/keyframe_thread.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

using std::chrono::milliseconds;

/// A map whose rendering is slow, waits while `closed` is set, or fails from one rendering on.
class SlowRoom : public test::BoxRoom {
 public:
  milliseconds pause{0};
  std::atomic<bool> closed{false};
  int fails_from = 1 << 30;  // number of the rendering, from 0
  std::atomic<int> begun{0};

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override {
    const int number = begun++;
    std::this_thread::sleep_for(pause);
    while (closed) std::this_thread::sleep_for(milliseconds(1));
    if (number >= fails_from) throw std::runtime_error("the device is gone");
    return BoxRoom::render(camera, T_world_camera, request);
  }
};

class BackgroundOdometry : public testing::Test {
 protected:
  static OdometryOptions background() {
    OdometryOptions options;
    options.background = true;
    return options;
  }

  /// Plays `frames` images at intervals of `spacing`, and finishes.
  void play(Odometry& odometry, int frames, milliseconds spacing) {
    for (int k = 0; k < frames; ++k) {
      live_.push_back(odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0));
      std::this_thread::sleep_for(spacing);
    }
    odometry.finish();
  }

  static double ate(const Trajectory& trajectory) {
    double squares = 0.0;
    for (const StampedPose& pose : trajectory) {
      const SE3 truth = test::room_path(static_cast<int>(std::lround(pose.time * 30.0)));
      squares += (truth.inverse() * pose.T_world_camera).translation().squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(trajectory.size()));
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom world_;
  std::vector<TrackResult> live_;
};

TEST_F(BackgroundOdometry, FollowsThePathWhenKeyframesComeInTime) {
  SlowRoom map;
  Odometry odometry(camera_, map, background(), test::room_path(0));
  play(odometry, 90, milliseconds(30));
  const OdometryStatistics s = odometry.statistics();
  EXPECT_EQ(s.posed, 90);
  EXPECT_GE(s.keyframes, 4);
  EXPECT_EQ(s.anchored, s.keyframes);
  EXPECT_GE(s.prefetched, 1);
  const Trajectory trajectory = odometry.trajectory();
  ASSERT_EQ(trajectory.size(), 90U);
  EXPECT_LT(ate(trajectory), 0.001);
}

TEST_F(BackgroundOdometry, NoFrameIsMissingFromTheRecordWhenKeyframesComeLate) {
  SlowRoom map;
  map.pause = milliseconds(60);
  Odometry odometry(camera_, map, background(), test::room_path(0));
  play(odometry, 90, milliseconds(5));
  const OdometryStatistics s = odometry.statistics();
  EXPECT_EQ(s.frames, 90);
  EXPECT_EQ(s.posed, 90);
  EXPECT_GE(s.keyframes, 3);
  const Trajectory trajectory = odometry.trajectory();
  ASSERT_EQ(trajectory.size(), 90U);
  for (std::size_t k = 0; k < 90; ++k) EXPECT_DOUBLE_EQ(trajectory[k].time, static_cast<double>(k) / 30.0);
  EXPECT_LT(ate(trajectory), 0.002);
  const std::vector<double> times = odometry.keyframe_times();
  EXPECT_EQ(static_cast<int>(times.size()), s.keyframes);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
}

TEST_F(BackgroundOdometry, TrackingDoesNotWaitForTheMap) {
  SlowRoom map;
  Odometry odometry(camera_, map, background(), test::room_path(0));
  odometry.track(world_.gray(camera_, test::room_path(0)), 0.0);
  map.pause = milliseconds(2000);
  // The camera moves until a keyframe is due.
  int k = 1;
  while (map.begun < 2 && k < 60) {
    const TrackResult result = odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0);
    EXPECT_EQ(result.status, TrackStatus::ok);
    EXPECT_LT(result.milliseconds, 1500.0);
    std::this_thread::sleep_for(milliseconds(5));
    ++k;
  }
  EXPECT_EQ(map.begun, 2);
  EXPECT_EQ(odometry.statistics().keyframes, 1);
}

TEST_F(BackgroundOdometry, FramesThatCameMeanwhileTakePartInACorrection) {
  // Without colours the first keyframe keeps the start pose, which is wrong by 6 cm and 3 degrees. The next one is
  // corrected by the map, while frames are still tracked against the first.
  SlowRoom map;
  map.with_color = false;
  OdometryOptions options = background();
  options.prefetch_images = 0.0;
  const SE3 error(so3_exp({0.03, -0.03, 0.02}), {0.04, -0.03, 0.03});
  Odometry odometry(camera_, map, options, test::room_path(0) * error);
  const auto track = [&](int k) {
    EXPECT_EQ(odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0).status, TrackStatus::ok) << k;
    std::this_thread::sleep_for(milliseconds(20));
  };
  const auto error_of = [](const StampedPose& pose) {
    const SE3 truth = test::room_path(static_cast<int>(std::lround(pose.time * 30.0)));
    return (truth.inverse() * pose.T_world_camera).translation().norm();
  };
  track(0);
  map.with_color = true;
  map.closed = true;
  int k = 1;
  while (map.begun < 2 && k < 60) track(k++);
  ASSERT_EQ(map.begun, 2);
  for (int later = 0; later < 3; ++later) track(k++);
  EXPECT_EQ(odometry.statistics().keyframes, 1);
  for (const StampedPose& pose : odometry.trajectory()) EXPECT_GT(error_of(pose), 0.04) << pose.time;
  map.closed = false;
  odometry.finish();
  ASSERT_EQ(odometry.statistics().keyframes, 2);
  track(k);
  const double keyframe_time = odometry.keyframe_times()[1];
  const Trajectory trajectory = odometry.trajectory();
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(k) + 1);
  int corrected = 0;
  for (const StampedPose& pose : trajectory) {
    if (pose.time < keyframe_time) continue;
    EXPECT_LT(error_of(pose), 0.01) << pose.time;
    ++corrected;
  }
  EXPECT_GE(corrected, 5);
}

TEST_F(BackgroundOdometry, WhatTheMapThrowsReachesTheCaller) {
  SlowRoom map;
  map.fails_from = 1;
  Odometry odometry(camera_, map, background(), test::room_path(0));
  EXPECT_THROW(play(odometry, 90, milliseconds(5)), std::runtime_error);
  EXPECT_EQ(odometry.statistics().keyframes, 1);
}

TEST_F(BackgroundOdometry, AMapThatFailsAtOnceThrowsAtOnce) {
  SlowRoom map;
  map.fails_from = 0;
  Odometry odometry(camera_, map, background(), test::room_path(0));
  EXPECT_THROW(odometry.track(world_.gray(camera_, test::room_path(0)), 0.0), std::runtime_error);
  // It continues when the map works again.
  map.fails_from = 1 << 30;
  EXPECT_EQ(odometry.track(world_.gray(camera_, test::room_path(1)), 1 / 30.0).status, TrackStatus::ok);
}

TEST_F(BackgroundOdometry, MayBeDestroyedAtWork) {
  SlowRoom map;
  auto odometry = std::make_unique<Odometry>(camera_, map, background(), test::room_path(0));
  odometry->track(world_.gray(camera_, test::room_path(0)), 0.0);
  map.pause = milliseconds(100);
  for (int k = 1; map.begun < 2 && k < 60; ++k) {
    odometry->track(world_.gray(camera_, test::room_path(k)), k / 30.0);
    std::this_thread::sleep_for(milliseconds(2));
  }
  ASSERT_GE(map.begun, 2);
  odometry.reset();
  const int begun = map.begun;
  std::this_thread::sleep_for(milliseconds(150));
  EXPECT_EQ(map.begun, begun);
}

TEST_F(BackgroundOdometry, AKeyframeSeesTheViewThatCameWithItsFrame) {
  test::BoxRoom nothing;
  nothing.with_depth = false;
  Odometry odometry(camera_, nothing, background(), test::room_path(0));
  std::vector<std::shared_ptr<SlowRoom>> views;
  for (int k = 0; k < 60; ++k) {
    views.push_back(std::make_shared<SlowRoom>());
    views.back()->with_color = false;
    odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0, views.back());
    std::this_thread::sleep_for(milliseconds(10));
  }
  odometry.finish();
  EXPECT_EQ(nothing.renders, 0);
  EXPECT_GE(odometry.statistics().keyframes, 3);
  const std::vector<double> times = odometry.keyframe_times();
  for (std::size_t k = 0; k < views.size(); ++k) {
    const bool keyframe = std::binary_search(times.begin(), times.end(), static_cast<double>(k) / 30.0);
    EXPECT_EQ(views[k]->begun, keyframe ? 1 : 0) << k;
  }
  EXPECT_LT(ate(odometry.trajectory()), 0.004);
}

TEST(KeyframeThread, ANewerRequestReplacesOneThatWaits) {
  const Camera camera = test::small_camera();
  SlowRoom map;
  map.pause = milliseconds(100);
  const ImageAligner aligner{ImageAlignerOptions()};
  KeyframeBackend backend(camera, map, aligner, {});
  KeyframeThread thread(backend);
  const auto request = [&](int k) {
    KeyframeRequest r;
    r.frame.number = k;
    r.frame.time = k;
    r.frame.T_world_camera = test::room_path(k);
    r.frame.image = make_even(
        std::make_shared<FramePyramid>(build_frame_pyramid(camera, map.gray(camera, r.frame.T_world_camera))));
    return r;
  };
  // Requests wait while a view is rendered ahead.
  thread.prefetch(test::room_path(50));
  while (map.begun == 0) std::this_thread::yield();
  EXPECT_TRUE(thread.request(request(1)));
  EXPECT_TRUE(thread.request(request(2)));
  const auto finished = thread.wait();
  ASSERT_TRUE(finished.has_value());
  EXPECT_EQ(finished->request.frame.number, 2);
  EXPECT_EQ(finished->request.id, 0);
  ASSERT_TRUE(finished->outcome.made);
  EXPECT_FALSE(finished->outcome.prefetched);  // rendered at another pose
  EXPECT_EQ(map.begun, 2);
  EXPECT_FALSE(thread.take().has_value());
  // No request is started before the last result is taken.
  EXPECT_TRUE(thread.request(request(3)));
  while (map.begun < 3) std::this_thread::yield();
  EXPECT_FALSE(thread.request(request(4)));
  EXPECT_EQ(thread.wait()->request.id, 1);
}

TEST(KeyframeBackend, AViewRenderedAheadIsUsedFromNearbyOnly) {
  const Camera camera = test::small_camera();
  const SE3 T_world_camera = test::room_path(20);
  const SE3 beside(Eigen::Quaterniond::Identity(), {0.01, 0.0, 0.0});
  const SE3 away(Eigen::Quaterniond::Identity(), {0.2, 0.0, 0.0});
  for (const bool near : {true, false}) {
    test::BoxRoom map;
    const ImageAligner aligner{ImageAlignerOptions()};
    KeyframeBackend backend(camera, map, aligner, {});
    backend.prefetch(T_world_camera * (near ? beside : away));
    KeyframeRequest request;
    request.frame.T_world_camera = T_world_camera;
    request.frame.image =
        make_even(std::make_shared<FramePyramid>(build_frame_pyramid(camera, map.gray(camera, T_world_camera), 0.8)));
    const KeyframeOutcome outcome = backend.add(request);
    ASSERT_TRUE(outcome.made);
    EXPECT_EQ(outcome.prefetched, near);
    EXPECT_EQ(map.renders, near ? 1 : 2);
    // The view is used with its own pose: the keyframe's pose is that of its image, not that of the view.
    const SE3 error = T_world_camera.inverse() * outcome.window.back().T_world_camera;
    EXPECT_LT(error.translation().norm(), 0.001) << near;
  }
}

}  // namespace
}  // namespace odosplat
