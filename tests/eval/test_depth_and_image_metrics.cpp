// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/eval/depth_metrics.hpp"
#include "odosplat/eval/image_metrics.hpp"
#include "odosplat/eval/statistics.hpp"

namespace odosplat {
namespace {

TEST(DepthMetrics, AgreeWithSortedErrorsOverManyFrames) {
  Random random(1);
  DepthMetrics metrics;
  std::vector<double> errors;
  double sum = 0.0;
  for (int frame = 0; frame < 20; ++frame) {
    DepthImage truth(50, 60, 2.0F);
    DepthImage estimate(50, 60);
    for (float& z : estimate) z = static_cast<float>(2.0 + 0.01 * random.normal());
    metrics.add(estimate, truth);
    for (const float z : estimate) {
      errors.push_back(std::abs(static_cast<double>(z) - 2.0));
      sum += static_cast<double>(z) - 2.0;
    }
  }
  std::sort(errors.begin(), errors.end());
  const DepthErrors e = metrics.result();
  EXPECT_EQ(e.pixels, errors.size());
  EXPECT_DOUBLE_EQ(e.valid_share, 1.0);
  EXPECT_NEAR(e.median_abs_m / percentile(errors, 50.0), 1.0, 1e-3);
  EXPECT_NEAR(e.p90_m / percentile(errors, 90.0), 1.0, 1e-3);
  EXPECT_NEAR(e.rmse_m, statistics(errors).rmse, 1e-12);
  EXPECT_NEAR(e.mean_m, sum / static_cast<double>(errors.size()), 1e-12);
}

TEST(DepthMetrics, CountOnlyPixelsWithTruthInsideTheMask) {
  DepthImage truth(1, 6);
  truth << 1.0F, 1.0F, 1.0F, 0.0F, 1.0F, 1.0F;
  DepthImage estimate(1, 6);
  estimate << 1.5F, 0.0F, 1.0F, 9.0F, 7.0F, std::nanf("");
  cv::Mat1b mask(1, 6);
  mask << 255, 255, 1, 255, 0, 255;
  DepthMetrics metrics;
  metrics.add(estimate, truth, mask);
  const DepthErrors e = metrics.result();
  EXPECT_EQ(e.pixels, 4U);
  EXPECT_DOUBLE_EQ(e.valid_share, 0.5);
  EXPECT_DOUBLE_EQ(e.rmse_m, std::sqrt(0.25 / 2.0));
  EXPECT_NEAR(e.p90_m, 0.5, 0.5e-3);
}

TEST(DepthMetrics, NothingToJudgeGivesZeros) {
  DepthMetrics metrics;
  EXPECT_EQ(metrics.result().pixels, 0U);
  metrics.add(DepthImage(3, 3, 0.0F), DepthImage(3, 3, 1.0F));
  EXPECT_EQ(metrics.result().valid_share, 0.0);
  EXPECT_EQ(metrics.result().rmse_m, 0.0);
  metrics.add(DepthImage(3, 3, 1.0F), DepthImage(3, 3, 1.0F));
  EXPECT_EQ(metrics.result().median_abs_m, 0.0);
  EXPECT_THROW(metrics.add(DepthImage(3, 3, 1.0F), DepthImage(3, 4, 1.0F)), InputError);
}

TEST(DepthEdgeMask, MarksThePixelsNearASteepStep) {
  DepthImage depth(20, 30, 2.0F);
  depth.colRange(15, 30) = 3.0F;
  const cv::Mat1b mask = depth_edge_mask(depth, 3);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) EXPECT_EQ(mask(y, x) != 0, x >= 12 && x < 18) << x;
  }
  EXPECT_EQ(cv::countNonZero(depth_edge_mask(DepthImage(20, 30, 2.0F))), 0);
  depth.colRange(15, 30) = 2.05F;  // a smaller step than the mask's threshold
  EXPECT_EQ(cv::countNonZero(depth_edge_mask(depth)), 0);
  depth.colRange(15, 30) = 0.0F;  // missing depth is not an edge
  EXPECT_EQ(cv::countNonZero(depth_edge_mask(depth)), 0);
}

ColorImage noise_image(int rows, int cols, std::uint64_t seed) {
  Random random(seed);
  ColorImage image(rows, cols);
  for (cv::Vec3f& c : image)
    c = cv::Vec3f(static_cast<float>(random.uniform()), static_cast<float>(random.uniform()),
                  static_cast<float>(random.uniform()));
  return image;
}

TEST(Psnr, OfAConstantDifference) {
  const ColorImage a(20, 20, cv::Vec3f(0.5F, 0.5F, 0.5F));
  const ColorImage b(20, 20, cv::Vec3f(0.6F, 0.6F, 0.6F));
  EXPECT_NEAR(psnr_db(a, b), 20.0, 1e-5);
  EXPECT_TRUE(std::isinf(psnr_db(a, a)));
  EXPECT_THROW(psnr_db(a, ColorImage(20, 21)), InputError);
  EXPECT_THROW(psnr_db(ColorImage(), ColorImage()), InputError);
}

TEST(Ssim, IsOneForEqualImagesAndSymmetric) {
  const ColorImage a = noise_image(30, 40, 1);
  const ColorImage b = noise_image(30, 40, 2);
  EXPECT_NEAR(ssim(a, a), 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(ssim(a, b), ssim(b, a));
  EXPECT_LT(std::abs(ssim(a, b)), 0.15);
}

TEST(Ssim, OfConstantImagesIsTheLuminanceTerm) {
  const ColorImage a(15, 15, cv::Vec3f(0.25F, 0.25F, 0.25F));
  const ColorImage b(15, 15, cv::Vec3f(0.75F, 0.75F, 0.75F));
  const double c1 = 1e-4;
  EXPECT_NEAR(ssim(a, b), (2 * 0.25 * 0.75 + c1) / (0.0625 + 0.5625 + c1), 1e-9);
}

TEST(Ssim, AgreesWithTheFormulaOnOneWindow) {
  // An image of exactly one window, computed term by term from the definition.
  const ColorImage a = noise_image(11, 11, 3);
  const ColorImage b = noise_image(11, 11, 4);
  double expected = 0.0;
  for (int c = 0; c < 3; ++c) {
    double weights = 0.0;
    double ma = 0.0;
    double mb = 0.0;
    const auto weight = [](int x, int y) {
      return std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2.0 * 1.5 * 1.5));
    };
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 11; ++x) {
        weights += weight(x, y);
        ma += weight(x, y) * static_cast<double>(a(y, x)[c]);
        mb += weight(x, y) * static_cast<double>(b(y, x)[c]);
      }
    }
    ma /= weights;
    mb /= weights;
    double va = 0.0;
    double vb = 0.0;
    double ab = 0.0;
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 11; ++x) {
        const double da = static_cast<double>(a(y, x)[c]) - ma;
        const double db = static_cast<double>(b(y, x)[c]) - mb;
        va += weight(x, y) / weights * da * da;
        vb += weight(x, y) / weights * db * db;
        ab += weight(x, y) / weights * da * db;
      }
    }
    expected += (2 * ma * mb + 1e-4) * (2 * ab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4)) / 3.0;
  }
  EXPECT_NEAR(ssim(a, b), expected, 1e-9);
  EXPECT_THROW(ssim(noise_image(10, 30, 1), noise_image(10, 30, 2)), InputError);
}

TEST(DepthMetrics, CountsErrorsWithinTheirSigmas) {
  DepthMetrics metrics;
  const DepthImage truth = (DepthImage(1, 6) << 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F);
  const DepthImage estimate = (DepthImage(1, 6) << 1.005F, 0.985F, 1.025F, 1.5F, 1.5F, 0.0F);
  // sigma is unknown for the fifth pixel, and the sixth has no estimate.
  const cv::Mat1f sigma = (cv::Mat1f(1, 6) << 0.01F, 0.01F, 0.01F, 0.01F, 0.0F, 0.01F);
  metrics.add(estimate, truth, {}, sigma);
  const DepthErrors errors = metrics.result();
  EXPECT_EQ(errors.with_sigma, 4U);
  EXPECT_DOUBLE_EQ(errors.within_sigmas[0], 0.25);
  EXPECT_DOUBLE_EQ(errors.within_sigmas[1], 0.5);
  EXPECT_DOUBLE_EQ(errors.within_sigmas[2], 0.75);
  EXPECT_THROW(metrics.add(estimate, truth, {}, cv::Mat1f(2, 2, 0.1F)), InputError);
  DepthMetrics without;
  without.add(estimate, truth);
  EXPECT_EQ(without.result().with_sigma, 0U);
}

}  // namespace
}  // namespace odosplat
