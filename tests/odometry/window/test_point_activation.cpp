// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/odometry/points/immature_points.hpp"
#include "odosplat/odometry/window/point_activation.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class PointActivationTest : public testing::Test {
 protected:
  /// Keyframes on the room's path without a map; immature points of all but the newest, traced in all later frames.
  PointActivationTest() {
    for (int i = 0; i < 4; ++i) {
      auto keyframe = std::make_shared<Keyframe>();
      keyframe->id = i;
      keyframe->T_world_camera = test::room_path(7 * i);
      const GrayImage gray = room_.gray(camera_, keyframe->T_world_camera);
      const auto gradients = build_gradients(build_frame_pyramid(camera_, gray));
      keyframe->gradient = gradients.front();
      for (int k = 7 * i - 6; k <= 7 * i; ++k) {
        if (k > 0) trace_into(test::room_path(k));
      }
      keyframe->immature = make_immature_points(gradients, {}, 50.0 / 255, selector_, {});
      window_.keyframes.push_back(keyframe);
    }
  }

  void trace_into(const SE3& T_world_camera) {
    for (const auto& host : window_.keyframes) {
      trace_points(host->immature, T_world_camera.inverse() * host->T_world_camera,
                   build_frame_pyramid(camera_, room_.gray(camera_, T_world_camera)), {}, {});
    }
  }

  int active() const {
    std::size_t n = 0;
    for (const auto& keyframe : window_.keyframes) n += keyframe->points.size();
    return static_cast<int>(n);
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  PixelSelector selector_{{}};
  Window window_;
};

TEST_F(PointActivationTest, ActivePointsLieOnTheRoomsWalls) {
  const int made = activate_points(window_, camera_, {}, {});
  EXPECT_EQ(made, active());
  ASSERT_GT(made, 60);
  int right = 0;
  for (const auto& keyframe : window_.keyframes) {
    for (const WindowPoint& p : keyframe->points) {
      EXPECT_TRUE(p.estimated);
      EXPECT_FALSE(p.of_map);
      EXPECT_GT(p.agreeing, p.contradicting);
      const double truth = 1.0 / room_.depth(camera_, keyframe->T_world_camera, p.u, p.v);
      if (std::abs(inverse_depth(p, camera_, keyframe->T_world_camera) - truth) < 0.04 * truth) ++right;
    }
  }
  EXPECT_GE(right, 0.95 * made);
}

TEST_F(PointActivationTest, DensityIsControlled) {
  Window sparse;
  for (const auto& keyframe : window_.keyframes) sparse.keyframes.push_back(std::make_shared<Keyframe>(*keyframe));
  const int many = activate_points(window_, camera_, {}, {});
  ActivationOptions options;
  options.active_points = 60;
  const int few = activate_points(sparse, camera_, {}, options);
  EXPECT_GT(few, 10);
  EXPECT_LE(few, 80);  // 60 plus partial cells at the image's edge
  EXPECT_GT(many, few);
  // Only cells whose point could not be activated are free again.
  EXPECT_LT(activate_points(sparse, camera_, {}, options), few / 4);
}

TEST_F(PointActivationTest, PointsThatAreContradictedGo) {
  activate_points(window_, camera_, {}, {});
  const int before = active();
  Keyframe& host = *window_.keyframes[0];
  ASSERT_GT(host.points.size(), 3U);
  host.points[0].agreeing = 1;
  host.points[0].contradicting = 2;
  host.points[1].offset = -10.0;
  remove_bad_points(window_, camera_);
  EXPECT_EQ(active(), before - 2);
}

}  // namespace
}  // namespace odosplat
