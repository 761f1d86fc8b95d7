// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/content/noise.hpp"
#include "odosplat/synth/content/patterns.hpp"

namespace odosplat {
namespace {

using Color = Eigen::Vector3f;

TEST(Texture, TexelCentresGiveTheImageBack) {
  const ColorImage image = checker_pattern(8, 4, {0.2F, 0.4F, 0.6F}, {0.8F, 0.7F, 0.1F});
  const Texture texture(image, {1.0F, 1.0F}, Texture::Edge::repeat);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const Eigen::Vector2f uv((static_cast<float>(x) + 0.5F) / 8.0F, (static_cast<float>(y) + 0.5F) / 8.0F);
      const Color c = texture.sample(uv, 1.0F);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(from_linear(c[i]), image(y, x)[i], 0.003F);
    }
  }
}

TEST(Texture, FromAfarItIsTheMeanInLinearLight) {
  const Texture texture(checker_pattern(64, 8, {0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}), {1.0F, 1.0F},
                        Texture::Edge::repeat);
  for (const float footprint : {32.0F, 64.0F, 1e6F}) {
    EXPECT_NEAR(texture.sample({0.3F, 0.7F}, footprint).x(), 0.5F, 0.01F);
  }
}

TEST(Texture, RepeatsOrStopsAtItsEdge) {
  const ColorImage image = paint(16, 16, [](float x, float y) { return Color(x, y, 0.5F); });
  const Texture repeated(image, {1.0F, 1.0F}, Texture::Edge::repeat);
  const Texture clamped(image, {1.0F, 1.0F}, Texture::Edge::clamp);
  EXPECT_EQ(repeated.sample({0.25F, 0.25F}, 1.0F), repeated.sample({3.25F, -1.75F}, 1.0F));
  EXPECT_EQ(clamped.sample({2.0F, 0.5F}, 1.0F), clamped.sample({1.0F, 0.5F}, 1.0F));
  EXPECT_GT(clamped.sample({2.0F, 0.5F}, 1.0F).x(), 0.9F);
}

TEST(Texture, SizesOfOneAndOddSizesWork) {
  const Texture one(ColorImage(1, 1, cv::Vec3f(0.5F, 0.5F, 0.5F)), {1.0F, 1.0F}, Texture::Edge::repeat);
  EXPECT_NEAR(from_linear(one.sample({0.9F, 0.1F}, 5.0F).x()), 0.5F, 0.003F);
  const Texture odd(ColorImage(7, 3, cv::Vec3f(0.5F, 0.5F, 0.5F)), {1.0F, 1.0F}, Texture::Edge::clamp);
  for (const float footprint : {1.0F, 2.5F, 9.0F}) {
    EXPECT_NEAR(from_linear(odd.sample({0.9F, 0.1F}, footprint).y()), 0.5F, 0.003F);
  }
  EXPECT_THROW(Texture(ColorImage(), {1.0F, 1.0F}, Texture::Edge::clamp), InputError);
  EXPECT_THROW(Texture(ColorImage(2, 2), {0.0F, 1.0F}, Texture::Edge::clamp), InputError);
}

TEST(Noise, IsSmoothAndTiles) {
  for (const int period : {1, 3, 8}) {
    const auto p = static_cast<float>(period);
    for (int k = 0; k < 200; ++k) {
      const float x = 0.0371F * static_cast<float>(k);
      const float y = 0.0217F * static_cast<float>(k);
      EXPECT_NEAR(gradient_noise(x, y, period, 7), gradient_noise(x + p, y - 2.0F * p, period, 7), 1e-4F);
      EXPECT_NEAR(gradient_noise(x, y, period, 7), gradient_noise(x + 1e-3F, y, period, 7), 5e-3F);
      EXPECT_LT(std::abs(gradient_noise(x, y, period, 7)), 1.0F);
    }
  }
  EXPECT_EQ(gradient_noise(2.0F, 5.0F, 8, 7), 0.0F);  // at lattice points
}

TEST(Noise, HasMeanZeroAndDependsOnTheSeed) {
  double sum = 0.0;
  double square = 0.0;
  double product = 0.0;
  constexpr int n = 200;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float u = 0.31F * static_cast<float>(x);
      const float v = 0.31F * static_cast<float>(y);
      const float a = gradient_noise(u, v, 64, 1);
      sum += a;
      square += a * a;
      product += a * gradient_noise(u, v, 64, 2);
    }
  }
  EXPECT_NEAR(sum / (n * n), 0.0, 0.01);
  EXPECT_GT(square / (n * n), 0.02);
  EXPECT_LT(std::abs(product), 0.1 * square);
}

std::vector<ColorImage> all_patterns(std::uint32_t seed) {
  const Color a(0.3F, 0.2F, 0.1F);
  const Color b(0.7F, 0.6F, 0.5F);
  return {marble_pattern(64, 4, a, b, {1.0F, 1.0F, 1.0F}, seed),
          wood_pattern(64, 48, a, b, seed),
          plank_pattern(64, 6, a, b, seed),
          plaster_pattern(64, b, 0.05F, seed),
          brick_pattern(64, 64, 2, 6, seed),
          cloth_pattern(64, a, b, 3, seed),
          carpet_pattern(96, 64, seed),
          picture_pattern(64, 48, 0, seed),
          picture_pattern(64, 48, 1, seed),
          picture_pattern(64, 48, 2, seed),
          book_pattern(16, 64, seed),
          outdoor_pattern(64, 32, seed)};
}

TEST(Patterns, AreDeterministicInTheirSeedWhateverTheThreads) {
  const int before = threads();
  set_threads(1);
  const std::vector<ColorImage> one = all_patterns(5);
  set_threads(2);
  const std::vector<ColorImage> two = all_patterns(5);
  set_threads(before);
  const std::vector<ColorImage> other = all_patterns(6);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(0, cv::norm(one[i], two[i], cv::NORM_INF)) << "pattern " << i;
    EXPECT_GT(cv::norm(one[i], other[i], cv::NORM_INF), 0.01) << "pattern " << i;
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(one[i].reshape(1), &low, &high);
    EXPECT_GE(low, 0.0) << "pattern " << i;
    EXPECT_LE(high, 1.0) << "pattern " << i;
    EXPECT_GT(high - low, 0.02) << "pattern " << i;
  }
}

TEST(Patterns, ThoseThatTileHaveNoSeam) {
  const Color a(0.3F, 0.2F, 0.1F);
  const Color b(0.7F, 0.6F, 0.5F);
  const std::vector<ColorImage> tiling{marble_pattern(256, 4, a, b, {1.0F, 1.0F, 1.0F}, 3),
                                       wood_pattern(256, 256, a, b, 3), plaster_pattern(256, b, 0.1F, 3)};
  for (std::size_t i = 0; i < tiling.size(); ++i) {
    const ColorImage& image = tiling[i];
    double seam = 0.0;
    double inside = 0.0;
    for (int k = 0; k < 256; ++k) {
      seam += cv::norm(image(k, 0) - image(k, 255)) + cv::norm(image(0, k) - image(255, k));
      inside += cv::norm(image(k, 100) - image(k, 101)) + cv::norm(image(100, k) - image(101, k));
    }
    EXPECT_LT(seam, 2.0 * inside) << "pattern " << i;
  }
}

}  // namespace
}  // namespace odosplat
