// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/quality/sigma_calibration.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "tests/splat/corner_scene.hpp"

namespace odosplat {
namespace {

using test::CornerScene;
using test::CornerViews;

constexpr SigmaModel least{0.02F, 0.01F, 1e-4F, 1e-3F};

double sigma_of(const SigmaSample& s, const SigmaModel& m) {
  return std::hypot(
      std::hypot(static_cast<double>(m.spread) * s.spread, static_cast<double>(m.slope_px) * s.slope),
      std::hypot(static_cast<double>(m.depth_share) * s.depth, static_cast<double>(m.open_share) * s.open * s.depth));
}

/// Errors drawn from a model; a share `outliers` of them come from another surface.
std::vector<SigmaSample> drawn_from(const SigmaModel& model, double outliers, std::uint64_t seed) {
  Random random(seed);
  std::vector<SigmaSample> samples(30000);
  for (SigmaSample& s : samples) {
    s.depth = random.uniform(1.0, 5.0);
    s.spread = 0.02 * std::pow(random.uniform(), 3.0);
    s.slope = 0.05 * std::pow(random.uniform(), 3.0);
    s.open = 0.5 * std::pow(random.uniform(), 4.0);
    s.error = random.normal() * sigma_of(s, model);
    if (random.uniform() < outliers) s.error = random.uniform(-1.0, 1.0);
  }
  return samples;
}

TEST(SigmaCalibration, FindsTheModelThatErrorsWereDrawnFrom) {
  const SigmaModel truth{0.7F, 0.25F, 0.0015F, 0.05F};
  const auto samples = drawn_from(truth, 0.0, 1);
  const SigmaModel found = fit_sigma(samples, least);
  EXPECT_NEAR(found.spread, truth.spread, 0.1F * truth.spread);
  EXPECT_NEAR(found.slope_px, truth.slope_px, 0.1F * truth.slope_px);
  EXPECT_NEAR(found.depth_share, truth.depth_share, 0.1F * truth.depth_share);
  EXPECT_NEAR(found.open_share, truth.open_share, 0.2F * truth.open_share);
}

// For every kind of pixel: those whose sigma is mostly spread, mostly slope, or neither.
TEST(SigmaCalibration, TwoSigmasHoldWhatANormalDistributionsDo) {
  for (const double outliers : {0.0, 0.02}) {
    const auto samples = drawn_from({0.7F, 0.25F, 0.0015F, 0.05F}, outliers, 2);
    const SigmaModel found = fit_sigma(samples, least);
    const auto share_within = [&](const auto& belongs) {
      int within = 0;
      int all = 0;
      for (const SigmaSample& s : samples) {
        if (!belongs(s)) continue;
        ++all;
        within += std::abs(s.error) <= 2.0 * sigma_of(s, found) ? 1 : 0;
      }
      return static_cast<double>(within) / all;
    };
    EXPECT_NEAR(share_within([](const SigmaSample&) { return true; }), 0.9545, 0.005);
    EXPECT_NEAR(share_within([](const SigmaSample& s) { return s.spread > 0.01; }), 0.9545, 0.02);
    EXPECT_NEAR(share_within([](const SigmaSample& s) { return s.slope > 0.02; }), 0.9545, 0.02);
    EXPECT_NEAR(share_within([](const SigmaSample& s) { return s.spread < 0.001 && s.slope < 0.002; }), 0.9545, 0.02);
  }
}

TEST(SigmaCalibration, CountsWhatTheComparisonCannotShow) {
  auto samples = drawn_from({0.0F, 0.0F, 1e-4F, 0.0F}, 0.0, 3);
  for (SigmaSample& s : samples) s.shared_sigma = 0.001 * s.depth;
  EXPECT_NEAR(fit_sigma(samples, least).depth_share, 0.001F, 0.0002F);
}

TEST(SigmaCalibration, WithoutSamplesTheDefaults) {
  EXPECT_EQ(fit_sigma({}, least).depth_share, SigmaModel().depth_share);
}

TEST(SigmaCalibration, OfAMapCoversItsErrors) {
  const CornerScene scene;
  const auto context = compute::Context::open();
  Random random(3);
  PointCloud cloud = scene.cloud(0.05);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.points[i] += 0.004F * static_cast<float>(random.normal()) * cloud.normals[i];
  const Gaussians map = gaussians_from_cloud(cloud, {});
  const PointCloud smoothed = smoothed_cloud(cloud, {});
  InterpolationView surface(smoothed);
  CornerViews views(4);
  SigmaCalibrationOptions calibration;
  calibration.shared_sigma = noise_left(cloud, smoothed, {});
  EXPECT_NEAR(calibration.shared_sigma, 0.004 / 5.0, 0.0004);
  const SigmaModel model = calibrated_sigma(context, map, views, surface, calibration);
  GaussianViewOptions options;
  options.sigma = model;
  GaussianView view(context, map, options);
  int within_two = 0;
  int all = 0;
  for (int k = 1; k < 8; k += 2) {
    const SE3 T_world_camera = scene.T_world_camera(k);
    const ViewImages images = view.render(scene.camera, T_world_camera, {});
    const DepthImage truth = scene.depth(T_world_camera);
    for (int y = 0; y < truth.rows; ++y) {
      for (int x = 0; x < truth.cols; ++x) {
        if (!(images.depth(y, x) > 0.0F) || !(truth(y, x) > 0.0F)) continue;
        ++all;
        within_two += std::abs(images.depth(y, x) - truth(y, x)) <= 2.0F * images.sigma(y, x) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(within_two, 0.85 * all);
  EXPECT_LT(model.depth_share, 0.01F);
}

TEST(SigmaModel, LinesGoThereAndBack) {
  const SigmaModel model{0.7F, 0.25F, 0.0015F, 0.05F};
  std::vector<std::string> lines = model.to_lines();
  lines.insert(lines.begin(), "iterations 2000");
  const SigmaModel back = SigmaModel::from_lines(lines);
  EXPECT_EQ(back.spread, model.spread);
  EXPECT_EQ(back.open_share, model.open_share);
  EXPECT_EQ(SigmaModel::from_lines({}).slope_px, SigmaModel().slope_px);
  EXPECT_THROW(SigmaModel::from_lines({"sigma_spread much"}), InputError);
  EXPECT_THROW(SigmaModel::from_lines({"sigma_spread -1"}), InputError);
}

// Two walls, the nearer one with an opacity of 0.6: expected depth lies between them, surface depth on one of them.
TEST(SurfaceDepth, LiesOnASurfaceWhereTwoMeet) {
  Gaussians g;
  g.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t a = 0; a < 3; ++a) g.log_scales[3 * i + a] = std::log(0.3F);
    g.log_scales[3 * i + 2] = std::log(0.01F);
    g.positions[3 * i + 2] = i == 0 ? 1.0F : 2.0F;
    g.rotations[4 * i] = 1.0F;
    g.opacity_logits[i] = i == 0 ? 0.4F : 4.0F;  // opacity 0.6, then nearly 1
  }
  const Camera camera{9, 9, 40.0, 40.0, 4.0, 4.0};
  const auto context = compute::Context::open();
  GaussianViewOptions options;
  GaussianView surface(context, g, options);
  options.depth_mode = DepthMode::expected;
  GaussianView expected(context, g, options);
  EXPECT_NEAR(surface.render(camera, SE3(), {}).depth(4, 4), 1.0F, 1e-3F);
  EXPECT_NEAR(expected.render(camera, SE3(), {}).depth(4, 4), 1.4F, 0.05F);
  EXPECT_THROW(depth_mode("best"), InputError);
}

}  // namespace
}  // namespace odosplat
