// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/adam.hpp"

namespace odosplat {
namespace {

/// Kingma and Ba 2015, algorithm 1, one parameter in double precision.
struct ReferenceAdam {
  double m = 0.0;
  double v = 0.0;
  int t = 0;
  double step(double g, double rate) {
    ++t;
    m = 0.9 * m + 0.1 * g;
    v = 0.999 * v + 0.001 * g * g;
    return rate * (m / (1.0 - std::pow(0.9, t))) / (std::sqrt(v / (1.0 - std::pow(0.999, t))) + 1e-15);
  }
};

class AdamSize : public testing::TestWithParam<int> {};

TEST_P(AdamSize, EqualsReference) {
  const auto rows = static_cast<std::size_t>(GetParam());
  constexpr std::size_t stride = 12;
  const auto context = compute::Context::open();
  Random random(11);
  std::vector<float> parameters(rows * stride);
  for (float& p : parameters) p = static_cast<float>(random.normal());
  std::vector<double> expected(parameters.begin(), parameters.end());
  std::vector<ReferenceAdam> twins(parameters.size());
  compute::Buffer<float> device(context, parameters);
  Adam adam(context, {}, stride, 3, 0.05F);
  for (int t = 0; t < 20; ++t) {
    const double rate = 0.01 / (1.0 + t);
    std::vector<float> gradients(parameters.size());
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      gradients[i] = i % 7 == 0 ? 0.0F : static_cast<float>(1e-6 * random.normal());
      const double ratio = i % stride < 3 ? 1.0 : 0.05;
      expected[i] -= twins[i].step(static_cast<double>(gradients[i]), rate * ratio);
    }
    adam.step(device, {context, gradients}, rate);
  }
  const std::vector<float> got = device.download();
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_NEAR(static_cast<double>(got[i]), expected[i], 3e-6 * (1.0 + std::abs(expected[i]))) << "element " << i;
  EXPECT_EQ(adam.steps(), 20);
}

// 12 floats per row: sizes below, near and above the 16 elements of a work-item.
INSTANTIATE_TEST_SUITE_P(Rows, AdamSize, testing::Values(1, 4, 5, 333));

TEST(Adam, NoElementsIsNoError) {
  const auto context = compute::Context::open();
  compute::Buffer<float> empty(context, 0);
  Adam adam(context, {}, 3, 3, 0.0F);
  adam.step(empty, empty, 0.1);
  EXPECT_TRUE(empty.download().empty());
}

TEST(Adam, FindsTheMinimumOfAQuadratic) {
  const auto context = compute::Context::open();
  const std::vector<float> goal{1.0F, -2.0F, 0.5F};
  compute::Buffer<float> x(context, std::vector<float>{0.0F, 0.0F, 0.0F});
  Adam adam(context, {}, 3, 3, 0.0F);
  for (int t = 0; t < 800; ++t) {
    std::vector<float> gradient = x.download();
    for (std::size_t i = 0; i < 3; ++i) gradient[i] = 2.0F * (gradient[i] - goal[i]);
    adam.step(x, {context, gradient}, 0.05 * std::pow(0.99, t));
  }
  const auto got = x.download();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], goal[i], 1e-3F);
}

TEST(AdamOptions, RefusesBetaOfOne) {
  AdamOptions options;
  options.beta1 = 1.0F;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
