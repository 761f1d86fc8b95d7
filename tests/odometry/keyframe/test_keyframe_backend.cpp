// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_backend.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

/// Asks for a keyframe that is to be confirmed, of the room's image from there. told: the back end's camera.
KeyframeOutcome first_keyframe(KeyframeBackend& backend, const Camera& told, const SE3& T_world_camera) {
  const test::BoxRoom room;
  KeyframeRequest request;
  request.frame.T_world_camera = T_world_camera;
  request.frame.image = make_even(
      std::make_shared<FramePyramid>(build_frame_pyramid(told, room.gray(test::small_camera(), T_world_camera), 0.8)));
  request.to_be_confirmed = true;
  return backend.add(request);
}

TEST(KeyframeBackend, AKeyframeThatAWrongCameraMovesIsNotMade) {
  KeyframeBackendOptions options;
  options.misfit.covariance_factor = 0.01;  // a single image makes the error significant
  options.max_misfit = {1e-6, 1e-6};
  const ImageAligner aligner{ImageAlignerOptions()};
  int moved = 0;
  for (const double factor : {0.95, 1.05}) {
    Camera told = test::small_camera();
    told.fx *= factor;
    told.fy *= factor;
    for (const int k : {0, 30, 60, 90}) {
      SCOPED_TRACE(k);
      test::BoxRoom map;
      KeyframeBackendOptions unlimited = options;
      unlimited.max_misfit = {};
      KeyframeBackend lenient(told, map, aligner, unlimited);
      const KeyframeOutcome plain = first_keyframe(lenient, told, test::room_path(k));
      // Some views the map does not confirm with such a camera, and of some a single image does not tell it.
      if (!plain.made || !plain.misfit.significant()) continue;
      ++moved;
      EXPECT_EQ(lenient.window().keyframes.size(), 1U);
      KeyframeBackend strict(told, map, aligner, options);
      const KeyframeOutcome refused = first_keyframe(strict, told, test::room_path(k));
      EXPECT_FALSE(refused.made);
      EXPECT_TRUE(strict.window().keyframes.empty());
      EXPECT_EQ(refused.evidence.verdict, Confirmation::confirmed);
      EXPECT_GT(refused.misfit.sigmas, MisfitEffect::likely_sigmas);
    }
  }
  EXPECT_GT(moved, 0);
}

}  // namespace
}  // namespace odosplat
