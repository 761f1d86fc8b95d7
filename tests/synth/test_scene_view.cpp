// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/scene_view.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {
namespace {

const Camera camera{97, 71, 80.0, 81.0, 47.5, 35.2};  // unusual sizes
const SE3 T_world_camera = look_at({0.6, 0.5, 1.5}, {2.9, 2.3, 0.7});

std::shared_ptr<const Scene> box_room() {
  static const auto scene = std::make_shared<const Scene>(make_box_room(1));
  return scene;
}

TEST(SceneView, GivesWhatWasAskedFor) {
  SceneView view(box_room());
  const ViewImages depth_only = view.render(camera, T_world_camera, {});
  EXPECT_EQ(depth_only.depth.size(), cv::Size(97, 71));
  EXPECT_EQ(depth_only.sigma.size(), cv::Size(97, 71));
  EXPECT_TRUE(depth_only.alpha.empty());
  EXPECT_TRUE(depth_only.color.empty());
  const ViewImages all = view.render(camera, T_world_camera, {.color = true, .alpha = true});
  EXPECT_EQ(all.alpha.size(), cv::Size(97, 71));
  EXPECT_EQ(all.color.size(), cv::Size(97, 71));
  EXPECT_EQ(0, cv::norm(all.depth, depth_only.depth, cv::NORM_INF));
}

TEST(SceneView, SameCallSameBits) {
  SceneView a(box_room());
  SceneView b(box_room());
  const ViewImages x = a.render(camera, T_world_camera, {.color = true, .alpha = true});
  a.render(camera, SE3(), {.color = true, .alpha = true});
  const ViewImages y = a.render(camera, T_world_camera, {.color = true, .alpha = true});
  const ViewImages z = b.render(camera, T_world_camera, {.color = true, .alpha = true});
  for (const ViewImages* other : {&y, &z}) {
    EXPECT_EQ(0, cv::norm(x.depth, other->depth, cv::NORM_INF));
    EXPECT_EQ(0, cv::norm(x.color, other->color, cv::NORM_INF));
    EXPECT_EQ(0, cv::norm(x.alpha, other->alpha, cv::NORM_INF));
    EXPECT_EQ(0, cv::norm(x.sigma, other->sigma, cv::NORM_INF));
  }
}

TEST(SceneView, SigmaAndAlphaGoWithDepth) {
  SceneBuilder builder;
  builder.add_quad({2.0F, 0.0F, 1.0F}, {0.0F, -1.0F, 0.0F}, {0.0F, 0.0F, -2.0F}, builder.add_plain(1.0F, 1.0F, 1.0F));
  SceneViewOptions options;
  options.sigma = 0.004F;
  SceneView view(std::make_shared<const Scene>(builder.build_unlit()), options);
  const ViewImages images =
      view.render(camera, look_at({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), {.color = true, .alpha = true});
  int covered = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const bool hit = images.depth(y, x) > 0.0F;
      covered += hit ? 1 : 0;
      EXPECT_EQ(images.sigma(y, x), hit ? 0.004F : 0.0F);
      EXPECT_EQ(images.alpha(y, x), hit ? 1.0F : 0.0F);
    }
  }
  EXPECT_GT(covered, 500);
  EXPECT_LT(covered, camera.width * camera.height - 500);
}

TEST(SceneView, LookingAwayGivesZeros) {
  SceneBuilder builder;
  builder.add_quad({2.0F, 1.0F, 1.0F}, {0.0F, -2.0F, 0.0F}, {0.0F, 0.0F, -2.0F}, builder.add_plain(1.0F, 1.0F, 1.0F));
  SceneView view(std::make_shared<const Scene>(builder.build_unlit()));
  const ViewImages images =
      view.render(camera, look_at({0.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), {.color = true, .alpha = true});
  EXPECT_EQ(0, cv::countNonZero(images.depth));
  EXPECT_EQ(0, cv::countNonZero(images.sigma));
  EXPECT_EQ(0, cv::countNonZero(images.alpha));
  EXPECT_EQ(0, cv::norm(images.color, cv::NORM_INF));
}

TEST(SceneView, DepthAndColorOfTwoViewsAgree) {
  // The assumption of tracking: a pixel's point has the same colour and depth in a view from another pose.
  const SE3 T_world_other = look_at({0.75, 0.42, 1.45}, {2.9, 2.2, 0.75});
  SceneView view(box_room(), {.samples = 16});
  const Camera large{320, 240, 250.0, 250.0, 159.5, 119.5};
  const ViewImages here = view.render(large, T_world_camera, {.color = true});
  const ViewImages there = view.render(large, T_world_other, {.color = true});
  const GrayImage gray_here = to_gray(here.color);
  const GrayImage gray_there = to_gray(there.color);
  const SE3 T_other_camera = T_world_other.inverse() * T_world_camera;
  double difference = 0.0;
  double unmoved = 0.0;
  int n = 0;
  for (int v = 0; v < large.height; v += 3) {
    for (int u = 0; u < large.width; u += 3) {
      const Eigen::Vector3d p = T_other_camera * (large.ray(u, v) * here.depth(v, u));
      const Eigen::Vector2d q = large.project(p);
      if (q.x() < 1.0 || q.y() < 1.0 || q.x() > large.width - 2.0 || q.y() > large.height - 2.0) continue;
      const float seen = there.depth(static_cast<int>(std::lround(q.y())), static_cast<int>(std::lround(q.x())));
      if (std::abs(seen - p.z()) > 0.02) continue;  // occluded, or at an edge
      ++n;
      const float value = bilinear(gray_there, static_cast<float>(q.x()), static_cast<float>(q.y()));
      difference += std::abs(value - gray_here(v, u));
      unmoved += std::abs(gray_there(v, u) - gray_here(v, u));
    }
  }
  ASSERT_GT(n, 5000);
  EXPECT_LT(difference, 0.25 * unmoved);
  EXPECT_LT(difference / n, 0.03);
}

TEST(SceneView, RefusesWrongInput) {
  EXPECT_THROW(SceneView(nullptr), InputError);
  EXPECT_THROW(SceneView(box_room(), {.samples = 65}), InputError);
  EXPECT_THROW(SceneView(box_room(), {.sigma = 0.0F}), InputError);
}

}  // namespace
}  // namespace odosplat
