// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/moving_camera.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat {
namespace {

const Camera camera{80, 60, 60.0, 60.0, 39.5, 29.5};

const Scene& room() {
  static const Scene scene = make_box_room(1);
  return scene;
}

/// Motion of half a metre per second to the right, parallel to a wall.
SE3 moving(double time) {
  return look_at(Eigen::Vector3d(1.0 + 0.5 * time, 1.0, 1.3), Eigen::Vector3d(1.0 + 0.5 * time, 3.0, 1.3));
}

double largest_difference(const ColorImage& a, const ColorImage& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(MovingCamera, WithAFastShutterIsTheStillOne) {
  const Rendering still = render(room(), camera, moving(0.3));
  const Rendering same = render_moving(room(), camera, moving, 0.3, {});
  EXPECT_EQ(largest_difference(still.color, same.color), 0.0);
  EXPECT_EQ(cv::norm(still.depth, same.depth, cv::NORM_INF), 0.0);
}

TEST(MovingCamera, AtRestBlursNothing) {
  const Rendering still = render(room(), camera, moving(0.3));
  const Rendering open = render_moving(room(), camera, [](double) { return moving(0.3); }, 0.3, {0.02, 0.03, 4});
  EXPECT_LT(largest_difference(still.color, open.color), 1e-5);
}

TEST(MovingCamera, BlurIsTheMeanLightOfItsMoments) {
  ShutterOptions shutter;
  shutter.shutter_s = 0.2;
  shutter.moments = 2;
  const Rendering blurred = render_moving(room(), camera, moving, 1.0, shutter);
  const Rendering first = render(room(), camera, moving(0.95));
  const Rendering second = render(room(), camera, moving(1.05));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const float light = 0.5F * (to_linear(first.color(y, x)[1]) + to_linear(second.color(y, x)[1]));
      ASSERT_NEAR(blurred.color(y, x)[1], from_linear(light), 1e-4);
    }
  }
  const Rendering still = render(room(), camera, moving(1.0));
  EXPECT_EQ(cv::norm(still.depth, blurred.depth, cv::NORM_INF), 0.0);
  EXPECT_GT(largest_difference(still.color, blurred.color), 0.05);
}

TEST(MovingCamera, EveryRowHasItsOwnMoment) {
  ShutterOptions shutter;
  shutter.readout_s = 0.3;
  const Rendering rolling = render_moving(room(), camera, moving, 1.0, shutter);
  for (const int y : {0, 20, 59}) {
    const Rendering then = render(room(), camera, moving(1.0 + 0.3 * (y / 59.0 - 0.5)));
    EXPECT_LT(largest_difference(rolling.color.row(y), then.color.row(y)), 1e-5) << y;
  }
}

TEST(MovingCamera, IsTheSameWithAnyNumberOfThreads) {
  const int before = threads();
  set_threads(1);
  const Rendering one = render_moving(room(), camera, moving, 1.0, {0.1, 0.02, 3});
  set_threads(3);
  const Rendering three = render_moving(room(), camera, moving, 1.0, {0.1, 0.02, 3});
  set_threads(before);
  EXPECT_EQ(largest_difference(one.color, three.color), 0.0);
}

TEST(MovingCamera, RefusesBadOptions) {
  EXPECT_THROW(render_moving(room(), camera, moving, 0.0, {-0.1, 0.0, 3}), InputError);
  EXPECT_THROW(render_moving(room(), camera, moving, 0.0, {0.1, 0.0, 0}), InputError);
}

}  // namespace
}  // namespace odosplat
