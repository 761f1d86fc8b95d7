// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/points/pixel_selector.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

constexpr int width = 320;
constexpr int height = 240;

std::vector<GradientImage> gradients_of(const GrayImage& gray) {
  return build_gradients(build_frame_pyramid({gray.cols, gray.rows, 250, 250, 159.5, 119.5}, gray));
}

/// Blocks of random grey: strong texture on the left, a fifth of its contrast on the right.
GrayImage two_halves() {
  Random random(3);
  GrayImage gray(height, width);
  cv::Mat1f blocks(height / 4, width / 4);
  for (float& value : blocks) value = static_cast<float>(random.uniform());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float contrast = x < width / 2 ? 0.8F : 0.16F;
      gray(y, x) = 0.5F + contrast * (blocks(y / 4, x / 4) - 0.5F);
    }
  }
  return gray;
}

TEST(PixelSelector, FindsAboutAsManyAsWanted) {
  const auto gradients = gradients_of(two_halves());
  for (const int wanted : {200, 800, 2000}) {
    PixelSelector selector({});
    const auto pixels = selector.select(gradients, {}, wanted);
    EXPECT_GT(static_cast<int>(pixels.size()), 0.6 * wanted) << wanted;
    EXPECT_LE(static_cast<int>(pixels.size()), 1.25 * wanted) << wanted;
  }
}

TEST(PixelSelector, PicksStrongGradientsInsideTheBorderOnceEach) {
  const auto gradients = gradients_of(two_halves());
  const SelectorOptions options;
  PixelSelector selector(options);
  auto pixels = selector.select(gradients, {}, 1000);
  double mean = 0.0;
  for (const cv::Vec4f& g : gradients[0]) mean += std::sqrt(g[3]) / static_cast<double>(gradients[0].total());
  double picked = 0.0;
  for (const cv::Point& p : pixels) {
    EXPECT_GE(p.x, options.border);
    EXPECT_GE(p.y, options.border);
    EXPECT_LT(p.x, width - options.border);
    EXPECT_LT(p.y, height - options.border);
    picked += std::sqrt(gradients[0](p)[3]) / static_cast<double>(pixels.size());
  }
  EXPECT_GT(picked, 1.5 * mean);
  const auto before = [](const cv::Point& a, const cv::Point& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
  std::sort(pixels.begin(), pixels.end(), before);
  EXPECT_EQ(std::adjacent_find(pixels.begin(), pixels.end()), pixels.end());
}

TEST(PixelSelector, WeakRegionsGetPixelsToo) {
  const auto gradients = gradients_of(two_halves());
  PixelSelector selector({});
  const auto pixels = selector.select(gradients, {}, 1000);
  const auto right = std::count_if(pixels.begin(), pixels.end(), [](const cv::Point& p) { return p.x >= width / 2; });
  EXPECT_GT(static_cast<double>(right), 0.25 * static_cast<double>(pixels.size()));
}

TEST(PixelSelector, ThresholdsFollowTheRegion) {
  const auto gradients = gradients_of(two_halves());
  const PixelSelector selector({});
  const cv::Mat1f thresholds = selector.thresholds(gradients[0]);
  ASSERT_EQ(thresholds.size(), cv::Size(10, 7));
  EXPECT_GT(thresholds(3, 1), 1.3F * thresholds(3, 8));
  EXPECT_GE(thresholds(3, 8), static_cast<float>(SelectorOptions().offset));
}

TEST(PixelSelector, BlankImagesHaveNothingToPick) {
  GrayImage flat(height, width, 0.4F);
  PixelSelector selector({});
  EXPECT_TRUE(selector.select(gradients_of(flat), {}, 1000).empty());
  // Noise below the offset does not count as texture.
  Random random(1);
  for (float& value : flat) value += static_cast<float>(0.004 * random.normal());
  EXPECT_LT(selector.select(gradients_of(flat), {}, 1000).size(), 10U);
}

TEST(PixelSelector, KeepsToTheMask) {
  const auto gradients = gradients_of(two_halves());
  cv::Mat1b mask(height, width, uchar{0});
  mask(cv::Rect(40, 60, 100, 90)).setTo(1);
  PixelSelector selector({});
  const auto pixels = selector.select(gradients, mask, 300);
  ASSERT_GT(pixels.size(), 100U);
  for (const cv::Point& p : pixels) EXPECT_NE(mask(p), 0);
}

TEST(PixelSelector, SameInputSamePixels) {
  const auto gradients = gradients_of(two_halves());
  PixelSelector a({});
  PixelSelector b({});
  EXPECT_EQ(a.select(gradients, {}, 700), b.select(gradients, {}, 700));
}

TEST(PixelSelector, RefusesBadOptions) {
  SelectorOptions options;
  options.quantile = 1.5;
  EXPECT_THROW(PixelSelector{options}, InputError);
  options = {};
  options.block = 0;
  EXPECT_THROW(PixelSelector{options}, InputError);
}

}  // namespace
}  // namespace odosplat
