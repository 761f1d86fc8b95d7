// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"

#include <gtest/gtest.h>

#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

// In the left third of the image the map's depth is 30 cm too small and its colours are wrong.
TEST(KeyframeMaker, DepthIsTrustedWhereTheMapLooksLikeTheImage) {
  const Camera camera = test::small_camera();
  test::BoxRoom room;
  const SE3 T = test::room_path(20);
  const auto pyramid = std::make_shared<FramePyramid>(build_frame_pyramid(camera, room.gray(camera, T)));
  const auto make = [&](const ViewImages& view) {
    KeyframeMaker maker({});
    return maker.make(make_even(pyramid), build_gradients(*pyramid), {T, view}, {}, ImageAligner({}));
  };
  const int moved = camera.width / 3;
  // A block is up to 8 px wide: points near the border between the two parts are ignored.
  const auto is_on = [&](float u, bool left) {
    return left ? u < static_cast<float>(moved) - 10.0F : u > static_cast<float>(moved) + 10.0F;
  };
  ViewImages view = room.render(camera, T, {true, true});
  const MadeKeyframe right = make(view);
  view.depth.colRange(0, moved) -= 0.3F;
  cv::flip(view.color.colRange(0, moved), view.color.colRange(0, moved), 0);
  const MadeKeyframe wrong = make(view);
  ASSERT_TRUE(right.anchored && wrong.anchored);

  const auto mean_prior = [&](const MadeKeyframe& made, bool left) {
    double sum = 0.0;
    int points = 0;
    for (const WindowPoint& point : made.keyframe->points) {
      if (!point.of_map || !is_on(point.u, left)) continue;
      sum += point.prior_information;
      ++points;
    }
    EXPECT_GT(points, 20);
    return sum / points;
  };
  EXPECT_GT(mean_prior(wrong, false), 0.8 * mean_prior(right, false));
  EXPECT_LT(mean_prior(wrong, true), 0.1 * mean_prior(right, true));
  const auto mean_weight = [&](const MadeKeyframe& made, bool left) {
    double sum = 0.0;
    int points = 0;
    for (const ReferencePoint& point : made.reference.levels.front()) {
      if (!is_on(point.u, left)) continue;
      sum += static_cast<double>(point.weight);
      ++points;
    }
    EXPECT_GT(points, 20);
    return sum / points;
  };
  EXPECT_GT(mean_weight(wrong, false), 0.8 * mean_weight(right, false));
  EXPECT_LT(mean_weight(wrong, true), 0.2 * mean_weight(right, true));
}

}  // namespace
}  // namespace odosplat
