// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/losses.hpp"
#include "tests/splat/reference/image_loss.hpp"

namespace odosplat {
namespace {

/// Smooth image with noise, values about 0..1 [3 x height x width].
std::vector<float> make_image(int width, int height, std::uint64_t seed, double noise) {
  Random random(seed);
  std::vector<float> image;
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.push_back(static_cast<float>(0.5 + 0.3 * std::sin(0.3 * x + c) * std::cos(0.2 * y) +
                                           noise * (random.uniform() - 0.5)));
  return image;
}

std::vector<double> to_double(const std::vector<float>& v) { return {v.begin(), v.end()}; }

TEST(ReferenceLoss, GradientIsFiniteDifference) {
  constexpr int width = 9;
  constexpr int height = 7;
  const std::vector<double> target = to_double(make_image(width, height, 1, 0.3));
  std::vector<double> rendered = to_double(make_image(width, height, 2, 0.3));
  for (const bool squared : {false, true}) {
    const auto result = reference::image_loss(rendered, target, width, height, 0.2, squared);
    for (std::size_t i = 0; i < rendered.size(); i += 5) {
      constexpr double h = 1e-6;
      const double kept = rendered[i];
      rendered[i] = kept + h;
      const double plus = reference::image_loss(rendered, target, width, height, 0.2, squared).loss;
      rendered[i] = kept - h;
      const double minus = reference::image_loss(rendered, target, width, height, 0.2, squared).loss;
      rendered[i] = kept;
      EXPECT_NEAR(result.gradient[i], (plus - minus) / (2.0 * h), 1e-8) << "value " << i;
    }
  }
}

TEST(ReferenceLoss, WindowIsCentred) {
  // Both images are symmetric under a rotation by 180 degrees; with a centred window the gradient has the same
  // symmetry.
  constexpr std::size_t width = 13;
  constexpr std::size_t height = 13;
  std::vector<double> rendered(3 * width * height, 0.2);
  const std::vector<double> target(3 * width * height, 0.2);
  for (std::size_t c = 0; c < 3; ++c) rendered[c * width * height + 6 * width + 6] = 0.9;
  const auto result = reference::image_loss(rendered, target, width, height, 1.0, false);
  for (std::size_t i = 0; i < width * height; ++i)
    EXPECT_NEAR(result.gradient[i], result.gradient[width * height - 1 - i], 1e-15);
}

// The kernel computes variances as E[x^2] - E[x]^2 in float: for values below 1 the error is up to 2^-24, which is 7e-5
// of the constant 9e-4 added to them in SSIM. This is the worst case of one window; means over an image are closer.
constexpr double window_error = 7e-5;

class ImageLossSize : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(ImageLossSize, EqualsReference) {
  const auto [width, height] = GetParam();
  const auto context = compute::Context::open();
  const std::vector<float> target = make_image(width, height, 3, 0.2);
  const std::vector<float> rendered = make_image(width, height, 4, 0.2);
  for (const ColorTerm term : {ColorTerm::l1, ColorTerm::squared_l2}) {
    LossOptions options;
    options.color_term = term;
    ImageLoss loss(context, options);
    compute::Buffer<float> gradient;
    loss.evaluate({context, rendered}, {context, target}, width, height, gradient);
    const LossValue value = loss.value();
    const auto expected = reference::image_loss(to_double(rendered), to_double(target), width, height, 0.2,
                                                term == ColorTerm::squared_l2);
    EXPECT_NEAR(value.loss, expected.loss, 0.2 * window_error);
    EXPECT_NEAR(value.l1, expected.l1, 1e-6);
    EXPECT_NEAR(value.mse, expected.mse, 1e-6);
    EXPECT_NEAR(value.ssim, expected.ssim, window_error);
    const std::vector<float> got = gradient.download();
    ASSERT_EQ(got.size(), expected.gradient.size());
    // The gradient is a sum of terms that cancel, each up to 2 / C2 of the weight; tolerance: four roundings of such a
    // term.
    const double rounding = 4.0 * 6e-8 * (2.0 / 9e-4) * 0.2 / (3.0 * width * height);
    for (std::size_t i = 0; i < got.size(); ++i)
      ASSERT_NEAR(static_cast<double>(got[i]), expected.gradient[i], rounding) << "value " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ImageLossSize,
                         testing::Values(std::pair{1, 1}, std::pair{5, 3}, std::pair{8, 8}, std::pair{37, 29},
                                         std::pair{64, 11}));

TEST(ImageLoss, EqualImagesHaveNoLossAndNoGradient) {
  const auto context = compute::Context::open();
  const std::vector<float> image = make_image(33, 20, 5, 0.5);
  ImageLoss loss(context, {});
  compute::Buffer<float> gradient;
  loss.evaluate({context, image}, {context, image}, 33, 20, gradient);
  EXPECT_NEAR(loss.value().loss, 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(loss.value().psnr_db(), 100.0);
  for (const float g : gradient.download()) ASSERT_NEAR(static_cast<double>(g), 0.0, 1e-8);
}

TEST(ImageLoss, ChangeOfSizeIsClean) {
  const auto context = compute::Context::open();
  ImageLoss loss(context, {});
  compute::Buffer<float> gradient;
  for (const auto& [width, height] : {std::pair{40, 30}, std::pair{19, 15}, std::pair{40, 30}}) {
    const auto rendered = make_image(width, height, 6, 0.4);
    const auto target = make_image(width, height, 7, 0.4);
    loss.evaluate({context, rendered}, {context, target}, width, height, gradient);
    const auto expected = reference::image_loss(to_double(rendered), to_double(target), width, height, 0.2, false);
    EXPECT_NEAR(loss.value().loss, expected.loss, 1e-6) << width << " x " << height;
  }
}

TEST(ImageLoss, SameInputSameBits) {
  const auto context = compute::Context::open();
  const compute::Buffer<float> rendered(context, make_image(61, 43, 8, 0.4));
  const compute::Buffer<float> target(context, make_image(61, 43, 9, 0.4));
  ImageLoss one(context, {});
  ImageLoss two(context, {});
  compute::Buffer<float> a;
  compute::Buffer<float> b;
  one.evaluate(rendered, target, 61, 43, a);
  two.evaluate(rendered, target, 61, 43, b);
  EXPECT_EQ(one.value().loss, two.value().loss);
  const auto va = a.download();
  const auto vb = b.download();
  EXPECT_EQ(std::memcmp(va.data(), vb.data(), va.size() * sizeof(float)), 0);
}

TEST(LossOptions, RefusesWeightOutsideRange) {
  LossOptions options;
  options.ssim_weight = 1.5F;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
