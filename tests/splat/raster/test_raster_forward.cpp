// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Images of both shells compared with the double-precision reference (the twin) and with values computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/error.hpp"
#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

// At margins below `band` float32 may decide differently from double; at most this share of pixels may be affected.
constexpr double band = 2e-3;
constexpr double band_share = 0.12;

double share_in_band(const std::vector<double>& margin) {
  const auto inside = std::count_if(margin.begin(), margin.end(), [](double m) { return m <= band; });
  return static_cast<double>(inside) / static_cast<double>(margin.size());
}

class RasterForward : public testing::TestWithParam<Shell> {};

TEST_P(RasterForward, EqualsTwinOnAllScenes) {
  for (const auto& [compensated, order] :
       {std::pair{false, BlendOrder::depth}, {true, BlendOrder::depth}, {false, BlendOrder::distance}}) {
    Rasterizer rasterizer = make_rasterizer(GetParam(), compensated, DepthKind::automatic, order);
    for (const RasterScene& scene : all_scenes()) {
      for (const DepthMode mode : {DepthMode::expected, DepthMode::median, DepthMode::blended, DepthMode::surface}) {
        SCOPED_TRACE(scene.name + " mode " + std::to_string(static_cast<int>(mode)));
        RenderRequest request;
        request.color = true;
        request.sigma = mode == DepthMode::expected || mode == DepthMode::surface;
        request.depth_mode = mode;
        if (mode == DepthMode::surface) request.sigma_model = {0.8F, 0.6F, 0.004F, 0.3F};
        const HostImages images = render(rasterizer, test_context(), scene, request);
        const reference::Images truth =
            reference::composite(reference::project(reference::Scene(scene.gaussians), scene.camera,
                                                    scene.T_world_camera, rasterizer.options(), request),
                                 scene.camera, request);
        EXPECT_LE(share_in_band(truth.margin), band_share);
        EXPECT_EQ(count_different(truth.color, images.color, truth.margin, band, 2e-4), 0u);
        EXPECT_EQ(count_different(truth.alpha, images.alpha, truth.margin, band, 1e-4), 0u);
        EXPECT_EQ(count_different(truth.depth, images.depth, truth.margin, band, 5e-4), 0u);
        if (request.sigma) {
          EXPECT_EQ(count_different(truth.sigma, images.sigma, truth.margin, band, 5e-4), 0u);
        }
        // In the band a Gaussian of alpha 1/255 may be included or not: differences are bounded, and all values finite.
        EXPECT_EQ(count_different(truth.alpha, images.alpha, truth.margin, -1.0, 0.02), 0u);
        for (const std::vector<float>* image : {&images.color, &images.depth, &images.alpha, &images.sigma}) {
          EXPECT_TRUE(std::all_of(image->begin(), image->end(), [](float v) { return std::isfinite(v); }));
        }
      }
    }
  }
}

// Thin ellipses over many tiles: in some rows of tiles they contain no pixel centre although they pass through.
TEST_P(RasterForward, NeedlesOverManyTilesEqualTwin) {
  RasterScene scene = needle_scene();
  scene.camera = {150, 118, 160.0, 172.0, 70.7, 60.9};
  Rasterizer rasterizer = make_rasterizer(GetParam());
  RenderRequest request;
  request.color = true;
  const HostImages images = render(rasterizer, test_context(), scene, request);
  const reference::Images truth =
      reference::composite(reference::project(reference::Scene(scene.gaussians), scene.camera, scene.T_world_camera,
                                              rasterizer.options(), request),
                           scene.camera, request);
  EXPECT_LE(share_in_band(truth.margin), band_share);
  EXPECT_EQ(count_different(truth.alpha, images.alpha, truth.margin, band, 1e-4), 0u);
  EXPECT_EQ(count_different(truth.depth, images.depth, truth.margin, band, 5e-4), 0u);
  EXPECT_EQ(count_different(truth.color, images.color, truth.margin, band, 2e-4), 0u);
}

TEST_P(RasterForward, CentreDepthEqualsTwin) {
  Rasterizer rasterizer = make_rasterizer(GetParam(), false, DepthKind::centre);
  const RasterScene scene = overlapping_scene(200, 0, 3);
  const RenderRequest request;
  const HostImages images = render(rasterizer, test_context(), scene, request);
  const reference::Images truth =
      reference::composite(reference::project(reference::Scene(scene.gaussians), scene.camera, scene.T_world_camera,
                                              rasterizer.options(), request),
                           scene.camera, request);
  EXPECT_EQ(count_different(truth.depth, images.depth, truth.margin, band, 2e-4), 0u);
}

TEST_P(RasterForward, ShDegreeIsLimitedByRequest) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  const RasterScene scene = overlapping_scene(100, 3, 4);
  std::vector<std::vector<float>> images;
  for (int degree = 0; degree <= 3; ++degree) {
    RenderRequest request;
    request.color = true;
    request.depth = false;
    request.sh_degree = degree;
    const HostImages image = render(rasterizer, test_context(), scene, request);
    const reference::Images truth =
        reference::composite(reference::project(reference::Scene(scene.gaussians), scene.camera, scene.T_world_camera,
                                                rasterizer.options(), request),
                             scene.camera, request);
    EXPECT_EQ(count_different(truth.color, image.color, truth.margin, band, 2e-4), 0u) << degree;
    EXPECT_TRUE(image.depth.empty());
    images.push_back(image.color);
  }
  EXPECT_NE(images[0], images[1]);
  EXPECT_NE(images[1], images[2]);
  EXPECT_NE(images[2], images[3]);
}

TEST_P(RasterForward, RoundGaussianOnPixelCentreIsSymmetricAboutIt) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  RasterScene scene{"pixel", {}, {}, SE3()};
  scene.camera = {33, 17, 50.0, 50.0, 16.0, 8.0};
  // On the optical axis at 2 m: it projects to pixel (16, 8), where 0.04 m are one pixel.
  scene.gaussians.resize(1);
  scene.gaussians.positions = {0.0f, 0.0f, 2.0f};
  scene.gaussians.log_scales.assign(3, std::log(0.04f));
  scene.gaussians.rotations = {1.0f, 0.0f, 0.0f, 0.0f};
  scene.gaussians.opacity_logits = {0.0f};
  scene.gaussians.sh = {0.0f, 0.0f, 0.0f};
  RenderRequest request;
  request.color = true;
  const HostImages images = render(rasterizer, test_context(), scene, request);
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const double alpha = 0.5 * std::exp(-0.5 * (dx * dx + dy * dy) / 1.3);
      const auto at = static_cast<std::size_t>((8 + dy) * 33 + 16 + dx);
      EXPECT_NEAR(images.alpha[at], alpha, 2e-6) << dx << " " << dy;
      EXPECT_NEAR(images.color[at], 0.5 * alpha, 2e-6);
      EXPECT_NEAR(images.depth[at], 2.0, 1e-5);
    }
  }
  EXPECT_EQ(images.alpha[0], 0.0f);
  EXPECT_EQ(images.depth[0], 0.0f);
}

// A white Gaussian ahead, a black one beside it: the black one is farther from the camera, but has the smaller depth
// until the camera turns towards it.
TEST_P(RasterForward, WhatHidesWhatStaysByDistanceWhenTheCameraTurns) {
  RasterScene scene{"turned", {}, {33, 33, 20.0, 20.0, 16.0, 16.0}, SE3()};
  Gaussians& g = scene.gaussians;
  g.resize(2);
  g.positions = {0.0F, 0.0F, 2.0F, 1.4F, 0.0F, 1.9F};
  g.log_scales.assign(6, 0.0F);
  g.rotations = {1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  g.opacity_logits = {6.0F, 6.0F};
  g.sh = {1.7F, 1.7F, 1.7F, -1.7F, -1.7F, -1.7F};
  // Brightness on the ray halfway between the two.
  const Eigen::Vector3d ray = Eigen::Vector3d(0.0, 0.0, 2.0).normalized() + Eigen::Vector3d(1.4, 0.0, 1.9).normalized();
  const auto brightness = [&](BlendOrder order, double turn) {
    Rasterizer rasterizer = make_rasterizer(GetParam(), false, DepthKind::automatic, order);
    scene.T_world_camera = SE3(so3_exp({0.0, turn, 0.0}), Eigen::Vector3d::Zero());
    RenderRequest request;
    request.color = true;
    const HostImages images = render(rasterizer, test_context(), scene, request);
    const Eigen::Vector2d uv = scene.camera.project(scene.T_world_camera.inverse() * ray);
    return images.color[static_cast<std::size_t>(std::lround(uv.y()) * scene.camera.width + std::lround(uv.x()))];
  };
  for (const double turn : {-0.2, 0.0, 0.3}) {
    EXPECT_GT(brightness(BlendOrder::distance, turn), 0.5F) << turn;
    EXPECT_EQ(brightness(BlendOrder::depth, turn) > 0.5F, turn > 0.1) << turn;
  }
}

// Flat discs of 12 mm every 12 mm on a plane tilted by 60 degrees, seen with f = 480 from 2.5 m.
TEST_P(RasterForward, RayPlaneDepthOfSlantedDiscsHasNoBias) {
  RasterScene scene{"plane", {}, {64, 48, 480.0, 480.0, 31.5, 23.5}, SE3()};
  const double tilt = 60.0 * std::acos(-1.0) / 180.0;
  const Eigen::Quaterniond q(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d middle(0.0, 0.0, 2.5), normal = q * Eigen::Vector3d::UnitZ();
  Gaussians& g = scene.gaussians;
  for (int i = -40; i <= 40; ++i) {
    for (int j = -25; j <= 25; ++j) {
      const Eigen::Vector3d p = middle + q * Eigen::Vector3d(0.012 * i, 0.012 * j, 0.0);
      for (int k = 0; k < 3; ++k) g.positions.push_back(static_cast<float>(p[k]));
      for (double s : {0.012, 0.012, 0.0012}) g.log_scales.push_back(static_cast<float>(std::log(s)));
      for (double v : {q.w(), q.x(), q.y(), q.z()}) g.rotations.push_back(static_cast<float>(v));
      g.opacity_logits.push_back(1.3863f);
      for (int k = 0; k < 3; ++k) g.sh.push_back(0.0f);
    }
  }
  const auto bias = [&](DepthKind kind, DepthMode mode) {
    Rasterizer rasterizer = make_rasterizer(GetParam(), false, kind);
    RenderRequest request;
    request.depth_mode = mode;
    const HostImages images = render(rasterizer, test_context(), scene, request);
    double sum = 0.0, worst = 0.0;
    for (int y = 0; y < scene.camera.height; ++y) {
      for (int x = 0; x < scene.camera.width; ++x) {
        const double truth = normal.dot(middle) / normal.dot(scene.camera.ray(x, y));
        const double error = images.depth[static_cast<std::size_t>(y * scene.camera.width + x)] - truth;
        sum += error;
        worst = std::max(worst, std::abs(error));
      }
    }
    RecordProperty("worst_mm", std::to_string(1000.0 * worst));
    return std::abs(sum) / (scene.camera.width * scene.camera.height);
  };
  EXPECT_LT(bias(DepthKind::ray_plane, DepthMode::expected), 0.001);
  EXPECT_LT(bias(DepthKind::ray_plane, DepthMode::median), 0.001);
  // With the depth of their centres the same discs are biased.
  EXPECT_GT(bias(DepthKind::centre, DepthMode::expected), 0.004);
}

TEST_P(RasterForward, ImagesAreTheSameBitsTwice) {
  Rasterizer first = make_rasterizer(GetParam()), second = make_rasterizer(GetParam());
  const RasterScene scene = overlapping_scene(400, 3, 1);
  RenderRequest request;
  request.color = true;
  request.sigma = true;
  const HostImages a = render(first, test_context(), scene, request);
  (void)render(second, test_context(), needle_scene(), request);  // fills the second's buffers with other contents
  const HostImages b = render(second, test_context(), scene, request);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.sigma, b.sigma);
}

TEST_P(RasterForward, BrokenGaussiansAreNotDrawn) {
  const RasterScene clean = overlapping_scene(60, 0, 12);
  RasterScene broken = clean;
  Gaussians& g = broken.gaussians;
  const float nan = std::nanf(""), inf = INFINITY;
  const std::vector<std::vector<float>> positions = {{nan, 0, 2}, {0, inf, 2}, {0, 0, 2}, {0, 0, 2}, {0, 0, 2}};
  const std::vector<std::vector<float>> scales = {
      {-3, -3, -3}, {-3, -3, -3}, {90, -3, -3}, {nan, -3, -3}, {-3, -3, -3}};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    g.positions.insert(g.positions.end(), positions[i].begin(), positions[i].end());
    g.log_scales.insert(g.log_scales.end(), scales[i].begin(), scales[i].end());
    const float w = i == 4 ? 0.0f : 1.0f;  // the last has a quaternion of length 0
    g.rotations.insert(g.rotations.end(), {w, 0.0f, 0.0f, 0.0f});
    g.opacity_logits.push_back(1.0f);
    g.sh.insert(g.sh.end(), {0.1f, 0.2f, 0.3f});
  }
  Rasterizer rasterizer = make_rasterizer(GetParam());
  RenderRequest request;
  request.color = true;
  const HostImages a = render(rasterizer, test_context(), clean, request);
  const HostImages b = render(rasterizer, test_context(), broken, request);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.depth, b.depth);
}

TEST_P(RasterForward, SizesAroundTilesAreCovered) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  for (const int size : {1, 15, 16, 17, 31, 32, 33}) {
    RasterScene scene = overlapping_scene(150, 0, 14);
    scene.camera = {size, 48 - size, 20.0, 20.0, 0.5 * (size - 1), 0.5 * (47 - size)};
    const RenderRequest request;
    const HostImages images = render(rasterizer, test_context(), scene, request);
    const reference::Images truth =
        reference::composite(reference::project(reference::Scene(scene.gaussians), scene.camera, scene.T_world_camera,
                                                rasterizer.options(), request),
                             scene.camera, request);
    EXPECT_EQ(count_different(truth.alpha, images.alpha, truth.margin, band, 1e-4), 0u) << size;
    EXPECT_EQ(count_different(truth.depth, images.depth, truth.margin, band, 5e-4), 0u) << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Shells, RasterForward, testing::Values(Shell::tile, Shell::pixel),
                         [](const auto& shell) { return shell.param == Shell::tile ? "Tile" : "Pixel"; });

TEST(Rasterizer, BadRequestsAreRefused) {
  RasterizerOptions options;
  options.dilation = -1.0f;
  EXPECT_THROW(Rasterizer(test_context(), options), InputError);
  Rasterizer rasterizer = make_rasterizer(Shell::tile);
  DeviceGaussians gaussians;
  gaussians.upload(test_context(), {});
  DeviceGaussians gradients;
  RenderOutput output;
  EXPECT_THROW(rasterizer.backward(gaussians, {}, gradients), InputError);
  RenderRequest request;
  request.depth = false;
  request.sigma = true;
  EXPECT_THROW(rasterizer.forward(gaussians, odd_camera(), SE3(), request, output), InputError);
  Camera camera = odd_camera();
  camera.fx = 0.0;
  EXPECT_THROW(rasterizer.forward(gaussians, camera, SE3(), {}, output), InputError);
  rasterizer.forward(gaussians, odd_camera(), SE3(), {}, output);
  OutputGradients given;
  given.color = compute::Buffer<float>(test_context(), std::vector<float>(3 * 37 * 29, 1.0f));
  EXPECT_THROW(rasterizer.backward(gaussians, given, gradients), InputError);
}

}  // namespace
}  // namespace odosplat
