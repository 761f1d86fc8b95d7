// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/texture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace odosplat {
namespace {

/// Grey that increases by `levels` (of 255) per pixel in columns from..to and is constant elsewhere.
GrayImage ramp(int width, int height, int from, int to, float levels) {
  GrayImage image(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(y, x) = levels / 255.0F * static_cast<float>(std::clamp(x, from, to) - from);
    }
  }
  return image;
}

TEST(Texture, CountsPixelsThatAreSteepEnough) {
  // Central differences: columns 21..29 have the whole slope, 20 and 30 half of it.
  const TextureStatistic steep = texture_statistic(ramp(66, 34, 20, 30, 9.0F));
  EXPECT_NEAR(steep.share, 9.0 / 64.0, 1e-9);
  EXPECT_DOUBLE_EQ(texture_statistic(ramp(66, 34, 20, 30, 7.0F)).share, 0.0);
  EXPECT_NEAR(texture_statistic(ramp(66, 34, 20, 30, 17.0F)).share, 11.0 / 64.0, 1e-9);
}

TEST(Texture, TellsBlocksApart) {
  const TextureStatistic s = texture_statistic(ramp(70, 40, 20, 30, 9.0F));
  ASSERT_EQ(s.block_shares.size(), 2U);  // the rest of 70 x 40 is smaller than a block
  EXPECT_NEAR(s.block_shares[0], 9.0 / 31.0, 1e-9);
  EXPECT_DOUBLE_EQ(s.block_shares[1], 0.0);
}

TEST(Texture, SummaryIsOverAllBlocks) {
  TextureStatistic a;
  a.share = 0.2;
  a.block_shares = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5};
  TextureStatistic b;
  b.share = 0.4;
  b.block_shares = {0.6, 0.7, 0.8, 0.9, 1.0};
  const TextureSummary s = summarise_texture({a, b});
  EXPECT_EQ(s.images, 2);
  EXPECT_NEAR(s.share, 0.3, 1e-12);
  EXPECT_NEAR(s.block_p10, 0.1, 1e-12);
  EXPECT_NEAR(s.block_p50, 0.5, 1e-12);
  EXPECT_NEAR(s.block_p90, 0.9, 1e-12);
  EXPECT_NEAR(s.bare_blocks, 1.0 / 11.0, 1e-12);
}

TEST(Texture, NothingHasNone) {
  EXPECT_DOUBLE_EQ(texture_statistic(GrayImage(2, 2, 0.5F)).share, 0.0);
  EXPECT_EQ(summarise_texture({}).images, 0);
  EXPECT_DOUBLE_EQ(summarise_texture({}).share, 0.0);
}

}  // namespace
}  // namespace odosplat
