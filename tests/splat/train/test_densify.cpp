// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/train/densify.hpp"
#include "odosplat/splat/train/surface_terms.hpp"

namespace odosplat {
namespace {

float logit(double opacity) { return static_cast<float>(std::log(opacity / (1.0 - opacity))); }
double opacity_of(const TrainingRows& rows, std::size_t i) {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(rows.gaussians.opacity_logits[i])));
}

/// n discs of 2 cm in the plane z = 1, opacity 0.6, number i at x = i.
TrainingRows discs(std::size_t n) {
  TrainingRows rows;
  rows.gaussians.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    rows.gaussians.positions[3 * i] = static_cast<float>(i);
    rows.gaussians.positions[3 * i + 2] = 1.0F;
    rows.gaussians.log_scales[3 * i] = rows.gaussians.log_scales[3 * i + 1] = std::log(0.02F);
    rows.gaussians.log_scales[3 * i + 2] = std::log(0.002F);
    rows.gaussians.rotations[4 * i] = 1.0F;
    rows.gaussians.opacity_logits[i] = logit(0.6);
    rows.gaussians.sh[3 * i] = 0.1F * static_cast<float>(i);
  }
  rows.anchors = surface_anchors(rows.gaussians);
  rows.from.resize(n);
  std::iota(rows.from.begin(), rows.from.end(), std::int64_t{0});
  return rows;
}

void expect_consistent(const TrainingRows& rows) {
  rows.gaussians.check();
  EXPECT_EQ(rows.anchors.size(), 8 * rows.size());
  EXPECT_EQ(rows.from.size(), rows.size());
  for (const float v : rows.gaussians.positions) EXPECT_TRUE(std::isfinite(v));
  for (const float v : rows.gaussians.log_scales) EXPECT_TRUE(std::isfinite(v));
  for (const float v : rows.gaussians.opacity_logits) EXPECT_TRUE(std::isfinite(v));
}

// Opacity of N Gaussians at the same place, compared with that of the Gaussian they replace.
TEST(Relocate, SharedPlaceLooksLikeBefore) {
  for (const double opacity : {0.3, 0.8}) {
    for (const int n : {2, 3, 5}) {
      const double shared = 1.0 - std::pow(1.0 - opacity, 1.0 / n);
      const double ratio = relocated_size_ratio(opacity, shared, n);
      double before = 0.0;  // integral of alpha along a line through the centre, which the formula preserves
      double after = 0.0;
      constexpr double h = 1e-3;
      for (double r = 0.0; r < 8.0; r += h) {
        before += h * opacity * std::exp(-0.5 * r * r);
        after += h * (1.0 - std::pow(1.0 - shared * std::exp(-0.5 * r * r / (ratio * ratio)), n));
      }
      EXPECT_NEAR(after, before, 0.002 * before) << "opacity " << opacity << " n " << n;
    }
  }
  EXPECT_NEAR(relocated_size_ratio(0.5, 0.5, 1), 1.0, 1e-12);
}

TEST(Relocate, DeadMoveToTheLivingInTheirPlane) {
  TrainingRows rows = discs(20);
  for (const std::size_t i : {3U, 7U, 11U}) rows.gaussians.opacity_logits[i] = logit(0.001);
  DensifyOptions options;
  Random random(1);
  relocate(rows, options, random);
  expect_consistent(rows);
  ASSERT_EQ(rows.size(), 20U);  // without a budget no Gaussians are added
  int moved = 0;
  for (const std::size_t i : {3U, 7U, 11U}) {
    EXPECT_GT(opacity_of(rows, i), options.dead_opacity);
    EXPECT_NEAR(rows.gaussians.positions[3 * i + 2], 1.0F, 1e-6F);  // it stays on the surface
    EXPECT_EQ(rows.from[i], -1);
    const float x = rows.gaussians.positions[3 * i];
    EXPECT_LT(std::abs(x - std::round(x)), 0.1F);  // near a Gaussian that is not dead
    moved += std::abs(x - static_cast<float>(i)) > 0.5F ? 1 : 0;
    // The anchor is moved too.
    EXPECT_EQ(rows.anchors[8 * i], x);
  }
  EXPECT_GE(moved, 2);
  EXPECT_EQ(rows.from[0] == 0 || rows.from[0] == -1, true);
}

TEST(Relocate, GrowsToTheBudgetAndNoFurther) {
  TrainingRows rows = discs(100);
  DensifyOptions options;
  options.budget = 108;
  Random random(2);
  relocate(rows, options, random);
  EXPECT_EQ(rows.size(), 105U);
  relocate(rows, options, random);
  EXPECT_EQ(rows.size(), 108U);
  relocate(rows, options, random);
  EXPECT_EQ(rows.size(), 108U);
  expect_consistent(rows);
}

TEST(Relocate, AllDeadStayWhereTheyAre) {
  TrainingRows rows = discs(4);
  for (float& l : rows.gaussians.opacity_logits) l = logit(0.001);
  const std::vector<float> positions = rows.gaussians.positions;
  Random random(3);
  relocate(rows, {}, random);
  EXPECT_EQ(rows.gaussians.positions, positions);
}

TEST(CloneAndSplit, SmallAreClonedLargeAreSplitDeadAreRemoved) {
  TrainingRows rows = discs(5);
  rows.gaussians.log_scales[3 * 1] = std::log(0.5F);   // large
  rows.gaussians.opacity_logits[3] = logit(0.001);     // dead
  rows.gaussians.log_scales[3 * 4] = std::log(20.0F);  // far too large
  DensifyOptions options;
  options.method = DensifyMethod::split;
  Random random(4);
  clone_and_split(rows, options, {0.1, 5.0}, {1.0F, 1.0F, 1e-6F, 1e-6F, 1e-6F}, {10.0F, 10.0F, 10.0F, 10.0F, 10.0F},
                  random);
  expect_consistent(rows);
  ASSERT_EQ(rows.size(), 5U);  // 0, 1 and 2 are kept, 0 is cloned, 1 is split
  EXPECT_EQ(rows.gaussians.positions[0], rows.gaussians.positions[3 * 3]);
  EXPECT_NEAR(rows.gaussians.log_scales[3 * 1], std::log(0.5F / 1.6F), 1e-5F);
  EXPECT_NEAR(rows.gaussians.log_scales[3 * 4], std::log(0.5F / 1.6F), 1e-5F);
  EXPECT_NE(rows.gaussians.positions[3 * 1], rows.gaussians.positions[3 * 4]);
  EXPECT_EQ(rows.from[0], 0);
  EXPECT_EQ(rows.from[1], -1);
  EXPECT_EQ(rows.from[2], 2);
  EXPECT_EQ(rows.from[3], -1);
}

TEST(CloneAndSplit, BudgetGoesToTheMostPulled) {
  TrainingRows rows = discs(6);
  DensifyOptions options;
  options.method = DensifyMethod::split;
  options.budget = 7;
  Random random(5);
  clone_and_split(rows, options, {0.1, 5.0}, {1.0F, 2.0F, 9.0F, 1.0F, 1.0F, 1.0F}, std::vector<float>(6, 1.0F), random);
  ASSERT_EQ(rows.size(), 7U);
  EXPECT_EQ(rows.gaussians.positions[3 * 6], 2.0F);
}

TEST(DensifySizes, HoldFromATripodToABuilding) {
  const DensifyOptions options;
  constexpr double pixel = 0.008;                                             // [m]
  EXPECT_NEAR(densify_sizes(options, 1.2, pixel, true).split, 0.012, 1e-12);  // a room: by the cameras' extent
  EXPECT_NEAR(densify_sizes(options, 0.01, pixel, true).split, 0.5 * pixel, 1e-12);
  EXPECT_NEAR(densify_sizes(options, 40.0, pixel, true).split, 4.0 * pixel, 1e-12);
  EXPECT_NEAR(densify_sizes(options, 0.01, 0.0, true).split, 1e-4, 1e-12);  // size of a pixel unknown
  EXPECT_TRUE(std::isinf(densify_sizes(options, 0.01, pixel, true).largest));
  EXPECT_NEAR(densify_sizes(options, 0.01, pixel, false).largest, 0.005, 1e-12);
}

TEST(DensifyOptions, RefusesNonsense) {
  EXPECT_THROW(densify_method("more"), InputError);
  for (const char* name : {"none", "relocate", "split"}) EXPECT_EQ(name_of(densify_method(name)), name);
  DensifyOptions options;
  options.interval = 0;
  EXPECT_THROW(options.check(), InputError);
  options = {};
  options.least_split_px = 5.0;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
