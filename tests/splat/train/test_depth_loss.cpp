// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/depth_loss.hpp"

namespace odosplat {
namespace {

constexpr double knee = 1e-3;

struct DepthPair {
  std::vector<float> rendered, target, weight;
};

/// Depths 1..4 m, errors from zero to far beyond the cut; a tenth of the pixels of each image has no depth.
DepthPair make_pair(std::size_t pixels, std::uint64_t seed) {
  Random random(seed);
  DepthPair pair;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double z = random.uniform(1.0, 4.0);
    const double error = z * 0.1 * std::pow(random.uniform(-1.0, 1.0), 3.0);
    pair.target.push_back(random.uniform() < 0.1 ? 0.0F : static_cast<float>(z));
    pair.rendered.push_back(random.uniform() < 0.1 ? 0.0F : static_cast<float>(z + error));
    pair.weight.push_back(static_cast<float>(random.uniform()));
  }
  return pair;
}

/// The loss by its definition, in double.
double reference_loss(const std::vector<double>& rendered, const DepthPair& pair, const DepthLossOptions& options) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rendered.size(); ++i) {
    if (!(rendered[i] > 0.0) || !(pair.target[i] > 0.0F)) continue;
    const double t = static_cast<double>(pair.target[i]);
    const double rho = std::min(std::hypot((rendered[i] - t) / t, knee), options.cut);
    sum += static_cast<double>(pair.weight[i]) * rho;
  }
  return options.weight * sum / static_cast<double>(rendered.size());
}

class DepthLossSize : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(DepthLossSize, GradientIsFiniteDifferenceOfDefinition) {
  const auto [width, height] = GetParam();
  const DepthPair pair = make_pair(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 5);
  const auto context = compute::Context::open();
  const DepthLossOptions options{0.7, 0.04};
  DepthLoss loss(context, options);
  compute::Buffer<float> gradient;
  loss.evaluate({context, pair.rendered}, {context, pair.target}, {context, pair.weight}, width, height, gradient);
  const std::vector<float> slopes = gradient.download();
  std::vector<double> rendered(pair.rendered.begin(), pair.rendered.end());
  const double scale = options.weight / static_cast<double>(rendered.size());
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < rendered.size(); ++i) {
    const bool both = pair.rendered[i] > 0.0F && pair.target[i] > 0.0F;
    if (both) {
      const double t = static_cast<double>(pair.target[i]);
      const double rho = std::hypot((rendered[i] - t) / t, knee);
      sum += static_cast<double>(pair.weight[i]) * std::min(rho, options.cut);
      weights += static_cast<double>(pair.weight[i]);
      if (std::abs(rho - options.cut) < 1e-5) continue;  // at the cut both are valid
    }
    const double kept = rendered[i];
    constexpr double h = 1e-6;
    rendered[i] = kept + h;
    const double plus = reference_loss(rendered, pair, options);
    rendered[i] = kept - h;
    const double minus = reference_loss(rendered, pair, options);
    rendered[i] = kept;
    // A pixel without depth has gradient 0, although the finite difference would give it depth.
    const double expected = both ? (plus - minus) / (2.0 * h) : 0.0;
    EXPECT_NEAR(slopes[i], expected, 1e-3 * scale) << "pixel " << i;
  }
  EXPECT_NEAR(loss.mean_relative_error(), weights > 0.0 ? sum / weights : 0.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DepthLossSize,
                         testing::Values(std::pair(1, 1), std::pair(7, 3), std::pair(8, 9), std::pair(33, 17)));

TEST(DepthLoss, AnotherSurfaceDoesNotPull) {
  const auto context = compute::Context::open();
  DepthLoss loss(context, {1.0, 0.05});
  compute::Buffer<float> gradient;
  loss.evaluate({context, std::vector<float>{2.05F, 3.0F, 0.0F}}, {context, std::vector<float>{2.0F, 2.0F, 2.0F}},
                {context, std::vector<float>{1.0F, 1.0F, 1.0F}}, 3, 1, gradient);
  const auto slopes = gradient.download();
  EXPECT_GT(slopes[0], 0.0F);
  EXPECT_EQ(slopes[1], 0.0F);
  EXPECT_EQ(slopes[2], 0.0F);
}

TEST(DepthLoss, RefusesBadOptions) {
  EXPECT_THROW(DepthLossOptions({-1.0, 0.05}).check(), InputError);
  EXPECT_THROW(DepthLossOptions({1.0, 0.0}).check(), InputError);
}

}  // namespace
}  // namespace odosplat
