// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/odometry/keyframe/keyframe_policy.hpp"
#include "odosplat/odometry/window/window.hpp"

namespace odosplat {
namespace {

/// Points on a wall 2 m away, spread over the image.
TrackingReference wall(const Camera& camera) {
  TrackingReference reference;
  reference.cameras = {camera};
  reference.levels.resize(1);
  for (int y = 4; y < camera.height; y += 8) {
    for (int x = 4; x < camera.width; x += 8) {
      const Eigen::Vector3d p = 2.0 * camera.ray(x, y);
      ReferencePoint point{};
      point.x = static_cast<float>(p.x());
      point.y = static_cast<float>(p.y());
      point.z = static_cast<float>(p.z());
      reference.levels[0].push_back(point);
    }
  }
  return reference;
}

const Camera camera{320, 240, 240.0, 240.0, 159.5, 119.5};

Alignment moved(const SE3& T_target_host) {
  Alignment a;
  a.T_target_host = T_target_host;
  a.coverage = 1.0;
  a.rmse = 0.02;
  return a;
}

TEST(KeyframePolicy, StandingStillIsNoReason) {
  EXPECT_EQ(keyframe_score(wall(camera), moved(SE3()), 0.02, {}).score, 0.0);
}

TEST(KeyframePolicy, RotationCountsAsFullFlowOnly) {
  const auto score = keyframe_score(wall(camera), moved(SE3(so3_exp({0.0, 0.05, 0.0}), {0, 0, 0})), 0.02, {});
  EXPECT_EQ(score.translation_flow, 0.0);
  EXPECT_NEAR(score.full_flow, 0.05 * 240.0, 3.0);
}

TEST(KeyframePolicy, TranslationCountsAsBoth) {
  const auto score = keyframe_score(wall(camera), moved(SE3(so3_exp({0, 0, 0}), {0.1, 0.0, 0.0})), 0.02, {});
  EXPECT_NEAR(score.translation_flow, 240.0 * 0.1 / 2.0, 1e-6);
  EXPECT_NEAR(score.full_flow, 240.0 * 0.1 / 2.0, 1e-6);
}

TEST(KeyframePolicy, ImageSizeDoesNotMatter) {
  const Camera large = camera.resized(640, 480);
  const Alignment a = moved(SE3(so3_exp({0.01, 0.02, 0.0}), {0.05, 0.0, 0.03}));
  EXPECT_NEAR(keyframe_score(wall(large), a, 0.02, {}).score, keyframe_score(wall(camera), a, 0.02, {}).score, 0.02);
}

TEST(KeyframePolicy, BrightnessResidualAndCoverageCount) {
  Alignment brighter = moved(SE3());
  brighter.brightness.a = 0.6;
  EXPECT_GT(keyframe_score(wall(camera), brighter, 0.02, {}).score, 1.0);
  Alignment worse = moved(SE3());
  worse.rmse = 0.05;
  EXPECT_GT(keyframe_score(wall(camera), worse, 0.02, {}).score, 1.0);
  EXPECT_LT(keyframe_score(wall(camera), worse, 0.04, {}).score, 1.0);
  Alignment leaving = moved(SE3());
  leaving.coverage = 0.4;
  EXPECT_GT(keyframe_score(wall(camera), leaving, 0.02, {}).score, 1.0);
}

std::shared_ptr<Keyframe> keyframe_at(double x, double turn) {
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->T_world_camera = SE3(so3_exp({0.0, turn, 0.0}), {x, 0.0, 0.0});
  for (int i = 0; i < 50; ++i) {
    WindowPoint point;
    point.u = static_cast<float>(20 + 5 * i);
    point.v = 120.0F;
    point.plane_world = world_plane({0.0, 0.0, 0.5}, keyframe->T_world_camera);
    keyframe->points.push_back(point);
  }
  return keyframe;
}

TEST(Window, KeepsAllWhileThereIsRoom) {
  Window window;
  for (int i = 0; i < 6; ++i) window.keyframes.push_back(keyframe_at(0.1 * i, 0.0));
  EXPECT_EQ(keyframe_to_drop(window, camera, {}), -1);
}

TEST(Window, DropsWhatTheNewestDoesNotSee) {
  Window window;
  for (int i = 0; i < 7; ++i) window.keyframes.push_back(keyframe_at(0.1 * i, i == 3 ? 2.0 : 0.0));
  EXPECT_EQ(keyframe_to_drop(window, camera, {}), 3);
}

TEST(Window, DropsOneOfACrowdFarFromTheNewest) {
  Window window;
  for (const double x : {0.0, 0.01, 0.02, 0.3, 0.5, 0.6, 0.65}) window.keyframes.push_back(keyframe_at(x, 0.0));
  const int drop = keyframe_to_drop(window, camera, {});
  EXPECT_GE(drop, 0);
  EXPECT_LE(drop, 2);
}

}  // namespace
}  // namespace odosplat
