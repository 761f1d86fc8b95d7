// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Gradients of both shells compared with the double-precision reference (the twin).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/random.hpp"
#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

constexpr double band = 2e-3;

struct Case {
  RasterScene scene;
  DepthMode mode = DepthMode::expected;
  DepthKind kind = DepthKind::automatic;
  bool compensated = false;
  BlendOrder order = BlendOrder::depth;
  bool color = true, depth = true, alpha = true;
};

struct Result {
  Gaussians gradients;
  Vector6d pose = Vector6d::Zero();
  std::vector<float> screen;
};

Result run(Rasterizer& rasterizer, const Case& c, const reference::ImageGradients& given) {
  const compute::Context& context = test_context();
  DeviceGaussians gaussians, gradients;
  gaussians.upload(context, c.scene.gaussians);
  RenderRequest request;
  request.color = c.color;
  request.depth = c.depth;
  request.depth_mode = c.mode;
  RenderOutput output;
  rasterizer.forward(gaussians, c.scene.camera, c.scene.T_world_camera, request, output);
  OutputGradients device;
  const auto upload = [&](const std::vector<double>& from, compute::Buffer<float>& to) {
    if (!from.empty()) to = compute::Buffer<float>(context, std::vector<float>(from.begin(), from.end()));
  };
  upload(given.color, device.color);
  upload(given.depth, device.depth);
  upload(given.alpha, device.alpha);
  Result result;
  rasterizer.backward(gaussians, device, gradients, &result.pose);
  result.gradients = gradients.download();
  result.screen = rasterizer.screen_gradients().download();
  return result;
}

// Random gradients of the images; zero at pixels where float and double may decide differently.
reference::ImageGradients make_given(const Case& c, const std::vector<double>& margin) {
  Random random(41);
  reference::ImageGradients given;
  if (c.color) given.color.resize(3 * margin.size());
  if (c.depth) given.depth.resize(margin.size());
  if (c.alpha) given.alpha.resize(margin.size());
  for (auto* image : {&given.color, &given.depth, &given.alpha}) {
    for (std::size_t i = 0; i < image->size(); ++i) {
      const double v = static_cast<double>(static_cast<float>(random.uniform(-1.0, 1.0)));
      (*image)[i] = margin[i % margin.size()] > band ? v : 0.0;
    }
  }
  return given;
}

// Largest difference, relative to the attribute's largest gradient.
double difference(const std::vector<double>& truth, const std::vector<float>& found) {
  double size = 1e-6, worst = 0.0;
  for (double v : truth) size = std::max(size, std::abs(v));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double d = std::abs(truth[i] - static_cast<double>(found[i]));
    worst = std::isfinite(d) ? std::max(worst, d) : INFINITY;
  }
  return worst / size;
}

void expect_equal(Shell shell, const Case& c, double tolerance) {
  Rasterizer rasterizer = make_rasterizer(shell, c.compensated, c.kind, c.order);
  RenderRequest request;
  request.color = c.color;
  request.depth_mode = c.mode;
  const reference::Scene scene(c.scene.gaussians);
  const std::vector<reference::Splat> splats =
      reference::project(scene, c.scene.camera, c.scene.T_world_camera, rasterizer.options(), request);
  reference::Decisions decisions;
  const reference::Images images = reference::composite(splats, c.scene.camera, request, nullptr, &decisions);
  const reference::ImageGradients given = make_given(c, images.margin);
  const std::vector<std::array<double, reference::splat_values>> splat_gradients =
      reference::composite_backward(splats, c.scene.camera, request, decisions, given);
  const reference::Gradients truth = reference::project_backward(scene, splats, request, splat_gradients);
  const Result found = run(rasterizer, c, given);
  ASSERT_EQ(found.gradients.size(), c.scene.gaussians.size());
  EXPECT_LT(difference(truth.scene.positions, found.gradients.positions), tolerance);
  EXPECT_LT(difference(truth.scene.log_scales, found.gradients.log_scales), tolerance);
  EXPECT_LT(difference(truth.scene.rotations, found.gradients.rotations), tolerance);
  EXPECT_LT(difference(truth.scene.opacity_logits, found.gradients.opacity_logits), tolerance);
  EXPECT_LT(difference(truth.scene.sh, found.gradients.sh), tolerance);
  std::vector<double> screen;
  for (const auto& s : splat_gradients) {
    screen.push_back(s[0]);
    screen.push_back(s[1]);
  }
  EXPECT_LT(difference(screen, found.screen), tolerance);
  EXPECT_LE((truth.pose - found.pose).norm(), tolerance * (1e-6 + truth.pose.norm()));
}

class RasterBackward : public testing::TestWithParam<Shell> {};

TEST_P(RasterBackward, EqualsTwinOnAllScenes) {
  for (const RasterScene& scene : all_scenes()) {
    SCOPED_TRACE(scene.name);
    expect_equal(GetParam(), {scene}, 1e-3);
  }
}

TEST_P(RasterBackward, EqualsTwinInAllDepthModes) {
  for (const DepthMode mode : {DepthMode::expected, DepthMode::median, DepthMode::blended}) {
    for (const DepthKind kind : {DepthKind::centre, DepthKind::ray_plane}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(mode)) + " " + std::to_string(static_cast<int>(kind)));
      Case c{overlapping_scene(150, 2, 17)};
      c.mode = mode;
      c.kind = kind;
      c.compensated = mode != DepthMode::blended;
      expect_equal(GetParam(), c, 1e-3);
    }
  }
}

TEST_P(RasterBackward, EqualsTwinSortedByDistance) {
  Case c{overlapping_scene(150, 2, 19)};
  c.order = BlendOrder::distance;
  expect_equal(GetParam(), c, 1e-3);
}

TEST_P(RasterBackward, EqualsTwinForEachImageAlone) {
  for (int image = 0; image < 3; ++image) {
    SCOPED_TRACE(image);
    Case c{overlapping_scene(150, 3, 18)};
    c.color = image == 0;
    c.depth = image == 1;
    c.alpha = image == 2;
    expect_equal(GetParam(), c, 1e-3);
  }
}

TEST_P(RasterBackward, GradientsAreTheSameBitsTwice) {
  const Case c{overlapping_scene(400, 3, 1)};
  const std::vector<double> margin(37 * 29, 1.0);
  const reference::ImageGradients given = make_given(c, margin);
  Rasterizer first = make_rasterizer(GetParam()), second = make_rasterizer(GetParam());
  const Result a = run(first, c, given);
  (void)run(second, {needle_scene()}, make_given({needle_scene()}, margin));
  const Result b = run(second, c, given);
  EXPECT_EQ(a.gradients.positions, b.gradients.positions);
  EXPECT_EQ(a.gradients.log_scales, b.gradients.log_scales);
  EXPECT_EQ(a.gradients.rotations, b.gradients.rotations);
  EXPECT_EQ(a.gradients.opacity_logits, b.gradients.opacity_logits);
  EXPECT_EQ(a.gradients.sh, b.gradients.sh);
  EXPECT_EQ(a.pose, b.pose);
}

INSTANTIATE_TEST_SUITE_P(Shells, RasterBackward, testing::Values(Shell::tile, Shell::pixel),
                         [](const auto& shell) { return shell.param == Shell::tile ? "Tile" : "Pixel"; });

}  // namespace
}  // namespace odosplat
