// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/align/image_aligner.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

/// The box room with so little contrast that the camera's noise is as large as the gradients.
class TrackingReferenceTest : public testing::Test {
 protected:
  FramePyramid seen_from(const SE3& T_world_camera, double contrast, std::uint64_t seed) {
    GrayImage image = room_.gray(camera_, T_world_camera);
    Random noise(seed);
    for (float& value : image) {
      value = static_cast<float>(0.5 + contrast * (value - 0.5) + noise.normal() / 255.0);
    }
    return build_frame_pyramid(camera_, image, 0.8);
  }

  TrackingReference reference_of(const FramePyramid& pyramid, bool with_weak) {
    PixelSelector usual({});
    PixelSelector weak(weak_selector_options());
    return build_reference(pyramid, build_gradients(pyramid), room_.render(camera_, T_world_host_, {}), usual, {}, {},
                           with_weak ? &weak : nullptr);
  }

  double error_m(const TrackingReference& reference, const FramePyramid& target, const SE3& truth) const {
    const Alignment found = ImageAligner({}).align(reference, target, SE3(), {}, 9, 0);
    return (truth.inverse() * found.T_target_host).translation().norm();
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  SE3 T_world_host_ = test::room_path(20);
};

TEST_F(TrackingReferenceTest, BareImagesAreFollowedByTheLittleThatTheyShow) {
  const double contrast = 0.08;
  const FramePyramid host = seen_from(T_world_host_, contrast, 1);
  const SE3 truth(so3_exp({0.01, -0.02, 0.015}), {0.03, 0.01, -0.02});
  const FramePyramid target = seen_from(T_world_host_ * truth.inverse(), contrast, 2);
  const TrackingReference usual = reference_of(host, false);
  const TrackingReference weak = reference_of(host, true);
  EXPECT_FALSE(usual.bare);
  EXPECT_TRUE(weak.bare);
  EXPECT_GT(weak.levels.front().size(), 10 * usual.levels.front().size());
  EXPECT_LT(error_m(weak, target, truth), 0.01);
  EXPECT_GT(error_m(usual, target, truth), 0.03);
}

TEST_F(TrackingReferenceTest, OrdinaryImagesAreNotBare) {
  const FramePyramid host = seen_from(T_world_host_, 1.0, 1);
  const TrackingReference usual = reference_of(host, false);
  const TrackingReference both = reference_of(host, true);
  EXPECT_FALSE(both.bare);
  EXPECT_EQ(both.levels.front().size(), usual.levels.front().size());
}

TEST_F(TrackingReferenceTest, AnImageWithoutDepthIsNotBareButEmpty) {
  room_.with_depth = false;
  const TrackingReference reference = reference_of(seen_from(T_world_host_, 0.08, 1), true);
  EXPECT_TRUE(reference.empty());
  EXPECT_FALSE(reference.bare);
}

TEST_F(TrackingReferenceTest, RefusesBadOptions) {
  ReferenceOptions options;
  options.bare_share = 1.5;
  EXPECT_THROW(options.check(), InputError);
  options = {};
  options.bare_factor = 0.5;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
