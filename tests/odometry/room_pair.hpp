// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "odosplat/odometry/odometry.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat::test {

/// A reference in the box room and images from a pose nearby, disturbed by the test.
class RoomPairTest : public testing::Test {
 protected:
  RoomPairTest() {
    const FramePyramid host = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_));
    PixelSelector selector({});
    reference_ =
        build_reference(host, build_gradients(host), room_.render(camera_, T_world_host_, {}), selector, {}, {});
  }

  std::shared_ptr<const FramePyramid> seen(const std::function<void(GrayImage&)>& spoil) const {
    GrayImage image = room_.gray(camera_, T_world_host_ * T_target_host_.inverse());
    spoil(image);
    return std::make_shared<FramePyramid>(build_frame_pyramid(camera_, image));
  }

  Alignment aligned(const FramePyramid& target) const { return aligner_.align(reference_, target, SE3(), {}, 9, 0); }

  double error_m(const Alignment& a) const { return (T_target_host_.inverse() * a.T_target_host).translation().norm(); }

  Camera camera_ = small_camera();
  BoxRoom room_;
  SE3 T_world_host_ = room_path(20);
  SE3 T_target_host_{so3_exp({0.01, -0.02, 0.015}), {0.03, 0.01, -0.02}};
  TrackingReference reference_;
  ImageAligner aligner_{{}};
};

/// Root mean square position error [m] of a run of 90 frames through the room; `spoil` disturbs image k before it is
/// tracked.
inline double error_of_run(const OdometryOptions& options, const std::function<void(int k, GrayImage&)>& spoil) {
  constexpr int frames = 90;
  const Camera camera = small_camera();
  BoxRoom room;
  Odometry odometry(camera, room, options, room_path(0));
  for (int k = 0; k < frames; ++k) {
    GrayImage image = room.gray(camera, room_path(k));
    spoil(k, image);
    odometry.track(image, k / 30.0);
  }
  EXPECT_EQ(odometry.statistics().lost, 0);
  double squares = 0.0;
  for (const StampedPose& pose : odometry.trajectory()) {
    const SE3 truth = room_path(static_cast<int>(std::lround(pose.time * 30.0)));
    squares += (truth.inverse() * pose.T_world_camera).translation().squaredNorm();
  }
  return std::sqrt(squares / frames);
}

}  // namespace odosplat::test
