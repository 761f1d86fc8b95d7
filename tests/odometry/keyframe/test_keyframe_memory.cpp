// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_memory.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class KeyframeMemoryTest : public testing::Test {
 protected:
  /// A keyframe with reference and covariance, as after the back end's adjustment.
  std::shared_ptr<Keyframe> keyframe(const SE3& T_world_camera) {
    const auto pyramid = std::make_shared<FramePyramid>(image(room_, T_world_camera));
    KeyframeMaker maker({});
    MadeKeyframe made = maker.make(make_even(pyramid), build_gradients(*pyramid),
                                   {T_world_camera, room_.render(camera_, T_world_camera, {true, true})}, {}, aligner_);
    made.keyframe->reference = std::make_shared<TrackingReference>(std::move(made.reference));
    made.keyframe->covariance = 1e-6 * Matrix6d::Identity();
    return made.keyframe;
  }
  FramePyramid image(const test::BoxRoom& room, const SE3& T_world_camera) const {
    return build_frame_pyramid(camera_, room.gray(camera_, T_world_camera));
  }
  static double error(const SE3& a, const SE3& b) { return (a.inverse() * b).translation().norm(); }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  ImageAligner aligner_{ImageAlignerOptions()};
  SE3 T_place_ = test::room_path(20);
  SE3 T_nearby_ = test::room_path(30);
};

TEST_F(KeyframeMemoryTest, APlaceIsFoundThoughTheCameraHasDrifted) {
  KeyframeMemory memory(camera_, {});
  const auto kept = keyframe(T_place_);
  memory.remember(kept, 0);
  const SE3 T_drifted = T_nearby_ * SE3(so3_exp({0.01, -0.02, 0.01}), {0.05, -0.03, 0.04});
  const auto found = memory.recall(image(room_, T_nearby_), T_drifted, aligner_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(error(found[0].T_world_camera, T_nearby_), 0.001);
  EXPECT_GT(found[0].flow, 1.0);
  EXPECT_LT(memory.recall(image(room_, T_nearby_), T_nearby_, aligner_)[0].flow, 0.1);
  const Anchor& anchor = found[0].anchor;
  EXPECT_EQ(anchor.T_world_view.matrix(), kept->T_world_camera.matrix());
  EXPECT_EQ(anchor.covariance, kept->covariance);
  EXPECT_DOUBLE_EQ(anchor.weight, KeyframeMemoryOptions().strength);
  ASSERT_EQ(anchor.points.size(), kept->points.size());
  for (const WindowPoint& point : anchor.points) EXPECT_FALSE(point.estimated);
}

TEST_F(KeyframeMemoryTest, AnotherRoomOrAnotherSideOfItIsNotFound) {
  KeyframeMemory memory(camera_, {});
  memory.remember(keyframe(T_place_), 0);
  test::BoxRoom other;
  other.detail = 1.7;
  EXPECT_TRUE(memory.recall(image(other, T_nearby_), T_nearby_, aligner_).empty());
  const SE3 T_turned = T_place_ * SE3(so3_exp({0.0, 2.5, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_TRUE(memory.recall(image(room_, T_turned), T_turned, aligner_).empty());
  // Nor with the remembered place as a wrong predicted pose.
  EXPECT_TRUE(memory.recall(image(room_, T_turned), T_place_, aligner_).empty());
}

TEST_F(KeyframeMemoryTest, TheLikestComeFirstAndSayMost) {
  KeyframeMemoryOptions options;
  options.known = 1.0;
  options.views = 2;
  KeyframeMemory memory(camera_, options);
  for (const int k : {5, 45, 26}) memory.remember(keyframe(test::room_path(k)), k == 26 ? 1 : 0);
  const auto found = memory.recall(image(room_, T_nearby_), T_nearby_, aligner_);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(error(found[0].anchor.T_world_view, test::room_path(26)), 1e-9);
  EXPECT_EQ(found[0].links, 1);
  EXPECT_EQ(found[1].links, 0);
  EXPECT_GT(found[0].anchor.weight, found[1].anchor.weight);
  EXPECT_NEAR(found[0].anchor.weight + found[1].anchor.weight, options.strength, 1e-9);
}

TEST_F(KeyframeMemoryTest, KeepsWhatIsNewAndNearTheMap) {
  KeyframeMemory memory(camera_, {});
  memory.remember(keyframe(T_place_), 0);
  memory.remember(keyframe(test::room_path(21)), 0);  // almost the same view
  EXPECT_EQ(memory.size(), 1U);
  const SE3 T_turned = T_place_ * SE3(so3_exp({0.0, 2.5, 0.0}), Eigen::Vector3d::Zero());
  memory.remember(keyframe(T_turned), 2);  // too far from the map
  EXPECT_EQ(memory.size(), 1U);
  const auto turned = keyframe(T_turned);
  memory.remember(turned, 1);
  EXPECT_EQ(memory.size(), 2U);
  memory.forget(*turned);
  EXPECT_EQ(memory.size(), 1U);
  EXPECT_EQ(memory.recall(image(room_, T_nearby_), T_nearby_, aligner_).size(), 1U);
}

TEST_F(KeyframeMemoryTest, WhatWasNotAskedForLongestGoesFirst) {
  KeyframeMemoryOptions options;
  options.capacity = 2;
  KeyframeMemory memory(camera_, options);
  const auto turned = [&](double angle) { return T_place_ * SE3(so3_exp({0.0, angle, 0.0}), Eigen::Vector3d::Zero()); };
  memory.remember(keyframe(turned(0.0)), 0);
  memory.remember(keyframe(turned(2.0)), 0);
  EXPECT_EQ(memory.recall(image(room_, turned(0.1)), turned(0.1), aligner_).size(), 1U);
  memory.remember(keyframe(turned(4.0)), 0);
  EXPECT_EQ(memory.size(), 2U);
  EXPECT_EQ(memory.recall(image(room_, turned(0.1)), turned(0.1), aligner_).size(), 1U);
  EXPECT_TRUE(memory.recall(image(room_, turned(2.1)), turned(2.1), aligner_).empty());
}

TEST_F(KeyframeMemoryTest, BadOptionsAreRefused) {
  for (double KeyframeMemoryOptions::*value : {&KeyframeMemoryOptions::strength, &KeyframeMemoryOptions::parallax,
                                               &KeyframeMemoryOptions::likeness, &KeyframeMemoryOptions::max_rmse}) {
    KeyframeMemoryOptions options;
    options.*value = -1.0;
    EXPECT_THROW(KeyframeMemory(camera_, options), InputError);
  }
}

}  // namespace
}  // namespace odosplat
