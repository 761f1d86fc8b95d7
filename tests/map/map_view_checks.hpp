// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat {

/// Requirements that every MapView must meet. The tests of each view call each check once.

inline bool same_bits(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y) {
    if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols) * a.elemSize()) != 0) return false;
  }
  return true;
}

inline void expect_same_bits(const ViewImages& a, const ViewImages& b) {
  EXPECT_TRUE(same_bits(a.depth, b.depth));
  EXPECT_TRUE(same_bits(a.sigma, b.sigma));
  EXPECT_TRUE(same_bits(a.alpha, b.alpha));
  EXPECT_TRUE(same_bits(a.color, b.color));
}

/// Checks sizes and values of rendered images.
inline void expect_well_formed(const ViewImages& images, const Camera& camera, const ViewRequest& request) {
  const cv::Size size(camera.width, camera.height);
  ASSERT_EQ(images.depth.size(), size);
  const auto size_or_empty = [&](const cv::Mat& image) { return image.empty() || image.size() == size; };
  ASSERT_TRUE(size_or_empty(images.sigma));
  ASSERT_TRUE(size_or_empty(images.color));
  EXPECT_TRUE(request.color || images.color.empty());
  if (request.alpha) {
    ASSERT_EQ(images.alpha.size(), size);
  } else {
    ASSERT_TRUE(size_or_empty(images.alpha));
  }
  int bad_depth = 0;
  int bad_sigma = 0;
  int bad_alpha = 0;
  int bad_color = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float z = images.depth(y, x);
      bad_depth += !(std::isfinite(z) && z >= 0.0F);
      if (!images.sigma.empty()) {
        const float s = images.sigma(y, x);
        bad_sigma += !(std::isfinite(s) && s >= 0.0F && (z > 0.0F || s == 0.0F));
      }
      if (!images.alpha.empty()) bad_alpha += !(images.alpha(y, x) >= 0.0F && images.alpha(y, x) <= 1.0F + 1e-5F);
      if (!images.color.empty()) {
        for (int c = 0; c < 3; ++c) bad_color += !std::isfinite(images.color(y, x)[c]);
      }
    }
  }
  EXPECT_EQ(bad_depth, 0) << "depth that is negative or not finite";
  EXPECT_EQ(bad_sigma, 0) << "sigma that is negative, not finite, or not 0 where there is no depth";
  EXPECT_EQ(bad_alpha, 0) << "alpha out of 0..1";
  EXPECT_EQ(bad_color, 0) << "colour that is not finite";
}

/// Checks that some pixels, one of them twice, equal those of the whole image.
inline void check_map_view_pixels(MapView& view, const Camera& camera, const SE3& T_world_camera) {
  const std::vector<cv::Point> pixels{{0, 0},
                                      {camera.width - 1, camera.height - 1},
                                      {camera.width / 2, camera.height / 2},
                                      {camera.width / 3, camera.height / 4},
                                      {0, 0}};
  const ViewRequest all{true, true};
  const ViewImages whole = view.render(camera, T_world_camera, all);
  const ViewImages some = view.render_pixels(camera, T_world_camera, all, pixels);
  const auto matches = [&](const auto& image, const auto& picked) {
    ASSERT_EQ(picked.empty(), image.empty());
    if (image.empty()) return;
    ASSERT_EQ(picked.size(), cv::Size(static_cast<int>(pixels.size()), 1));
    for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(picked(0, static_cast<int>(i)), image(pixels[i])) << i;
  };
  matches(whole.depth, some.depth);
  matches(whole.alpha, some.alpha);
  matches(whole.color, some.color);
  ASSERT_EQ(some.sigma.empty(), whole.sigma.empty());
  for (int i = 0; i < some.sigma.cols; ++i) EXPECT_EQ(some.sigma(0, i) > 0.0F, some.depth(0, i) > 0.0F);
  EXPECT_TRUE(view.render_pixels(camera, T_world_camera, all, {}).depth.empty());
  EXPECT_THROW(view.render_pixels(camera, T_world_camera, all, {{camera.width, 0}}), InputError);
  EXPECT_THROW(view.render_pixels(camera, T_world_camera, all, {{0, -1}}), InputError);
}

/// Checks a view with visible surfaces from T_world_camera: all requested images and none but depth, repeated calls,
/// one thread and several, and some pixels. The camera should have an unusual size.
inline void check_map_view(MapView& view, const Camera& camera, const SE3& T_world_camera) {
  EXPECT_FALSE(view.name().empty());
  const ViewRequest all{true, true};
  const ViewImages first = view.render(camera, T_world_camera, all);
  expect_well_formed(first, camera, all);
  EXPECT_GT(cv::countNonZero(first.depth), 0) << "nothing in view: the checks would say nothing";
  const ViewImages depth_only = view.render(camera, T_world_camera, {});
  expect_well_formed(depth_only, camera, {});
  EXPECT_TRUE(same_bits(first.depth, depth_only.depth)) << "depth depends on what else is asked for";
  expect_same_bits(first, view.render(camera, T_world_camera, all));
  const int before = threads();
  for (const int n : {1, 3}) {
    set_threads(n);
    expect_same_bits(first, view.render(camera, T_world_camera, all));
  }
  set_threads(before);
  check_map_view_pixels(view, camera, T_world_camera);
}

/// Checks the same view at sizes down to one pixel. Not for views with a fixed size.
inline void check_map_view_sizes(MapView& view, const Camera& camera, const SE3& T_world_camera) {
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 13}, {3, 50}}) {
    const Camera other = camera.resized(width, height);
    const ViewRequest all{true, true};
    expect_well_formed(view.render(other, T_world_camera, all), other, all);
  }
}

/// Checks that a view without visible surfaces gives zeros.
inline void check_empty_map_view(MapView& view, const Camera& camera, const SE3& T_world_camera) {
  const ViewRequest all{true, true};
  const ViewImages images = view.render(camera, T_world_camera, all);
  expect_well_formed(images, camera, all);
  EXPECT_EQ(cv::countNonZero(images.depth), 0);
  EXPECT_EQ(cv::countNonZero(images.alpha), 0);
}

}  // namespace odosplat
