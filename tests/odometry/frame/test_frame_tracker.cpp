// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/odometry/frame/frame_tracker.hpp"

namespace odosplat {
namespace {

TEST(FrameTracker, AKeyframesCorrectionIsNoMotion) {
  const SE3 step(so3_exp({0.0, 0.02, 0.0}), {0.01, 0.0, 0.02});
  const SE3 first(so3_exp({0.3, -0.1, 0.2}), {1.0, 2.0, 0.5});
  FrameTracker tracker{FrameTrackerOptions()};
  tracker.confirm(0.0, first);
  tracker.confirm(1.0, first * step);
  // The third frame becomes a keyframe, and the map corrects its tracked pose by 6 cm.
  const SE3 correction(so3_exp({0.01, 0.0, -0.02}), {0.05, -0.03, 0.02});
  ReferenceFrame keyframe;
  keyframe.id = 0;
  keyframe.T_world_camera = correction * first * step * step;
  tracker.set_references({keyframe}, correction);
  tracker.confirm(2.0, keyframe.T_world_camera);
  const SE3 expected = keyframe.T_world_camera * step;
  EXPECT_LT((expected.inverse() * predict(tracker.history(), 3.0)).log().norm(), 1e-9);
}

}  // namespace
}  // namespace odosplat
