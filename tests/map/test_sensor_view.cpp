// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/sensor_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "tests/map/map_view_checks.hpp"

namespace odosplat {
namespace {

const Camera camera_9{9, 7, 8.0, 8.0, 4.0, 3.0};

TEST(SensorView, GivesTheDepthThatWasSet) {
  DepthImage depth(7, 9, 2.0F);
  depth(1, 2) = 0.0F;
  depth(3, 3) = std::nanf("");
  depth(4, 4) = -1.0F;
  SensorView view;
  view.set_depth(depth);
  depth = 5.0F;  // the view has its own copy
  const ViewImages images = view.render(camera_9, SE3(), {false, true});
  EXPECT_EQ(cv::countNonZero(images.depth), 63 - 3);
  EXPECT_EQ(images.depth(0, 0), 2.0F);
  EXPECT_EQ(images.alpha(0, 0), 1.0F);
  EXPECT_EQ(images.alpha(3, 3), 0.0F);
  EXPECT_NEAR(images.sigma(0, 0), 0.0012 + 0.0019 * 1.6 * 1.6, 1e-7);
}

TEST(SensorView, KeepsWhatEveryMapViewKeeps) {
  SensorView view;
  check_empty_map_view(view, camera_9, SE3());
  view.set_depth(DepthImage(7, 9, 1.5F));
  check_map_view(view, camera_9, SE3());
  view.set_depth(DepthImage());
  check_empty_map_view(view, camera_9, SE3());
}

TEST(SensorView, RefusesOtherSizesAndBadOptions) {
  SensorView view;
  view.set_depth(DepthImage(5, 5, 1.0F));
  EXPECT_THROW(view.render(camera_9, SE3(), {}), InputError);
  SensorViewOptions options;
  options.sigma_constant = 0.0;
  EXPECT_THROW(SensorView{options}, InputError);
}

}  // namespace
}  // namespace odosplat
