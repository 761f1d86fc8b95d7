// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "box_room.hpp"
#include "odosplat/odometry/tracker.hpp"

namespace odosplat::test {

/// A reference in the box room and images from a little way off, spoilt by the test.
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

  Alignment aligned(const FramePyramid& target) const { return tracker_.align(reference_, target, SE3(), {}, 9, 0); }

  double error_m(const Alignment& a) const { return (T_target_host_.inverse() * a.T_target_host).translation().norm(); }

  Camera camera_ = small_camera();
  BoxRoom room_;
  SE3 T_world_host_ = room_path(20);
  SE3 T_target_host_{so3_exp({0.01, -0.02, 0.015}), {0.03, 0.01, -0.02}};
  TrackingReference reference_;
  Tracker tracker_{{}};
};

}  // namespace odosplat::test
