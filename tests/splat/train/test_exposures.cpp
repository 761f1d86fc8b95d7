// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/exposures.hpp"

namespace odosplat {
namespace {

constexpr int width = 13;
constexpr int height = 7;
constexpr std::size_t plane = width * height;

std::vector<float> random_image(std::uint64_t seed) {
  Random random(seed);
  std::vector<float> image(3 * plane);
  for (float& v : image) v = static_cast<float>(random.uniform());
  return image;
}

TEST(Exposures, StartWithTheMapsOwn) {
  const auto context = compute::Context::open();
  Exposures exposures(context, {0.01, 0.0}, 3);
  const std::vector<float> image = random_image(1);
  compute::Buffer<float> exposed;
  exposures.apply(2, {context, image}, exposed);
  EXPECT_EQ(exposed.download(), image);
}

TEST(Exposures, LearnGainAndOffsetOfAView) {
  const auto context = compute::Context::open();
  Exposures exposures(context, {0.01, 0.0}, 2);
  const std::vector<float> image = random_image(2);
  const double gains[3] = {1.3, 0.8, 1.0};
  const double offsets[3] = {-0.05, 0.1, 0.0};
  const compute::Buffer<float> rendered(context, image);
  compute::Buffer<float> exposed;
  for (int step = 0; step < 2000; ++step) {
    exposures.apply(1, rendered, exposed);
    std::vector<float> slope = exposed.download();  // gradient of the mean squared difference
    for (std::size_t i = 0; i < slope.size(); ++i) {
      const double target = gains[i / plane] * static_cast<double>(image[i]) + offsets[i / plane];
      slope[i] = static_cast<float>(2.0 * (static_cast<double>(slope[i]) - target) / static_cast<double>(slope.size()));
    }
    compute::Buffer<float> gradient(context, slope);
    exposures.backward(1, rendered, width, height, gradient);
  }
  const auto learnt = exposures.of(1);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(learnt[c], gains[c], 0.01);
    EXPECT_NEAR(learnt[3 + c], offsets[c], 0.01);
  }
  EXPECT_EQ(exposures.of(0)[0], 1.0);  // the other view is unchanged
}

TEST(Exposures, GradientPassesThroughTheGain) {
  const auto context = compute::Context::open();
  Exposures exposures(context, {0.01, 0.0}, 1);
  std::vector<double> state = exposures.state();
  state[0] = 2.0;
  state[1] = 0.5;
  state[3] = 0.25;
  exposures.set_state(state, 0);
  const std::vector<float> image = random_image(3);
  compute::Buffer<float> gradient(context, std::vector<float>(3 * plane, 1.0F));
  exposures.backward(0, {context, image}, width, height, gradient);
  const std::vector<float> slopes = gradient.download();
  EXPECT_EQ(slopes[0], 2.0F);
  EXPECT_EQ(slopes[plane], 0.5F);
  EXPECT_EQ(slopes[2 * plane], 1.0F);
  EXPECT_THROW(exposures.set_state({1.0}, 0), InputError);
}

}  // namespace
}  // namespace odosplat
