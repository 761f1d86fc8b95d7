// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "tests/map/map_view_checks.hpp"
#include "tests/splat/corner_scene.hpp"

namespace odosplat {
namespace {

using test::CornerScene;

Gaussians corner() { return gaussians_from_cloud(CornerScene().cloud(0.04), {}); }

TEST(GaussianView, DepthIsThatOfTheSurface) {
  const CornerScene scene;
  for (const DepthMode mode : {DepthMode::expected, DepthMode::median}) {
    GaussianViewOptions options;
    options.depth_mode = mode;
    GaussianView view(compute::Context::open(), corner(), options);
    const SE3 T_world_camera = scene.T_world_camera(3);
    const ViewImages images = view.render(scene.camera, T_world_camera, {true, true});
    double valid = 0.0;
    EXPECT_LT(test::depth_rmse(images.depth, scene.depth(T_world_camera), valid), 0.01);
    EXPECT_GT(valid, 0.99);
    EXPECT_GT(test::psnr_db(images.color, scene.color(T_world_camera)), 20.0);
    EXPECT_EQ(images.alpha.size(), images.depth.size());
    EXPECT_EQ(view.name(), "gaussian");
  }
}

TEST(GaussianView, KeepsWhatEveryMapViewMust) {
  const CornerScene scene;
  const auto context = compute::Context::open();
  for (const DepthMode mode : {DepthMode::expected, DepthMode::median}) {
    GaussianViewOptions options;
    options.depth_mode = mode;
    GaussianView view(context, corner(), options);
    check_map_view(view, scene.camera, scene.T_world_camera(3));
    check_map_view_sizes(view, scene.camera, scene.T_world_camera(3));
  }
  GaussianView empty(context, Gaussians{}, GaussianViewOptions());
  check_empty_map_view(empty, scene.camera, SE3());
}

TEST(GaussianView, SomePixelsHaveTheSigmaOfTheWhole) {
  const CornerScene scene;
  GaussianView view(compute::Context::open(), corner(), GaussianViewOptions());
  std::vector<cv::Point> pixels;
  for (int x = 0; x < scene.camera.width; x += 3) pixels.emplace_back(x, scene.camera.height / 2);
  const ViewImages whole = view.render(scene.camera, scene.T_world_camera(2), {});
  const ViewImages some = view.render_pixels(scene.camera, scene.T_world_camera(2), {}, pixels);
  for (int i = 0; i < some.sigma.cols; ++i) {
    EXPECT_EQ(some.sigma(0, i), whole.sigma(pixels[static_cast<std::size_t>(i)]));
  }
}

TEST(GaussianView, SigmaCoversTheSlopeAndHasAFloor) {
  const CornerScene scene;
  GaussianViewOptions options;
  GaussianView view(compute::Context::open(), corner(), options);
  const SE3 T_world_camera = scene.T_world_camera(2);
  const ViewImages images = view.render(scene.camera, T_world_camera, {});
  const DepthImage truth = scene.depth(T_world_camera);
  for (int y = 0; y < images.depth.rows; ++y)
    for (int x = 0; x < images.depth.cols; ++x) {
      if (images.depth(y, x) > 0.0F)
        EXPECT_GE(images.sigma(y, x), 0.003F * images.depth(y, x) * 0.9999F);
      else
        EXPECT_EQ(images.sigma(y, x), 0.0F);
    }
  // The lower part of the image shows the floor at a slant: sigma must cover the change of depth over half a pixel.
  const int y = scene.camera.height - 4;
  const int x = scene.camera.width / 2;
  // Slightly less, because the slopes of discs seen at a slant are limited (PLANE_DILATION).
  EXPECT_GT(images.sigma(y, x), 0.8F * 0.25F * std::abs(truth(y - 1, x) - truth(y + 1, x)));
  EXPECT_LT(images.sigma(y, x), 0.1F * truth(y, x));
}

TEST(GaussianView, ThinlyCoveredPixelsHaveNoDepth) {
  const CornerScene scene;
  Gaussians thin = corner();
  for (float& logit : thin.opacity_logits) logit = -3.0F;
  GaussianViewOptions options;
  options.min_alpha = 0.0F;
  const auto context = compute::Context::open();
  const SE3 T_world_camera = scene.T_world_camera(0);
  const ViewImages all = GaussianView(context, thin, options).render(scene.camera, T_world_camera, {false, true});
  options.min_alpha = 0.3F;
  const ViewImages some = GaussianView(context, thin, options).render(scene.camera, T_world_camera, {false, true});
  int dropped = 0;
  for (int y = 0; y < all.depth.rows; ++y)
    for (int x = 0; x < all.depth.cols; ++x) {
      EXPECT_EQ(some.depth(y, x), all.alpha(y, x) >= 0.3F ? all.depth(y, x) : 0.0F);
      dropped += all.depth(y, x) > 0.0F && some.depth(y, x) == 0.0F ? 1 : 0;
    }
  EXPECT_GT(dropped, 0);
  EXPECT_TRUE(all.color.empty());
}

TEST(GaussianView, EmptyMapGivesZeros) {
  const CornerScene scene;
  GaussianView view(compute::Context::open(), Gaussians{}, GaussianViewOptions());
  const ViewImages images = view.render(scene.camera, SE3(), {true, true});
  ASSERT_EQ(images.depth.cols, scene.camera.width);
  ASSERT_EQ(images.depth.rows, scene.camera.height);
  EXPECT_EQ(cv::countNonZero(images.depth), 0);
  EXPECT_EQ(cv::countNonZero(images.alpha), 0);
  EXPECT_EQ(cv::countNonZero(images.sigma), 0);
  EXPECT_EQ(cv::countNonZero(images.color.reshape(1)), 0);
}

TEST(GaussianView, SameCallSameBits) {
  const CornerScene scene;
  GaussianView view(compute::Context::open(), corner(), GaussianViewOptions());
  const ViewImages a = view.render(scene.camera, scene.T_world_camera(1), {true, true});
  view.render(scene.camera.level(1), scene.T_world_camera(4), {});  // another size in between
  const ViewImages b = view.render(scene.camera, scene.T_world_camera(1), {true, true});
  EXPECT_EQ(std::memcmp(a.depth.data, b.depth.data, a.depth.total() * sizeof(float)), 0);
  EXPECT_EQ(std::memcmp(a.sigma.data, b.sigma.data, a.sigma.total() * sizeof(float)), 0);
  EXPECT_EQ(std::memcmp(a.color.data, b.color.data, a.color.total() * sizeof(cv::Vec3f)), 0);
}

TEST(GaussianView, ColourStaysInRange) {
  const CornerScene scene;
  Gaussians bright = corner();
  for (float& s : bright.sh) s *= 20.0F;
  const ViewImages images = GaussianView(compute::Context::open(), bright, GaussianViewOptions())
                                .render(scene.camera, scene.T_world_camera(0), {true, false});
  float largest = 0.0F;
  for (const cv::Vec3f& c : images.color)
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(c[k], 0.0F);
      largest = std::max(largest, c[k]);
    }
  EXPECT_EQ(largest, 1.0F);
}

TEST(GaussianViewOptions, RefusesAlphaOutsideRange) {
  GaussianViewOptions options;
  options.min_alpha = 2.0F;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
