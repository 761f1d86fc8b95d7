// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Rendering of some pixels: the same bits as in the whole image.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

class RasterPixels : public testing::TestWithParam<Shell> {};

// The corners, one of them twice, and random pixels.
std::vector<cv::Point> some_pixels(const Camera& camera, int random_ones, std::uint64_t seed) {
  std::vector<cv::Point> pixels{
      {0, 0}, {camera.width - 1, camera.height - 1}, {0, camera.height - 1}, {camera.width - 1, 0}, {0, 0}};
  Random random(seed);
  for (int i = 0; i < random_ones; ++i) {
    pixels.push_back({static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(camera.width))),
                      static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(camera.height)))});
  }
  return pixels;
}

HostImages render_pixels(Rasterizer& rasterizer, const RasterScene& scene, const RenderRequest& request,
                         const std::vector<cv::Point>& pixels) {
  DeviceGaussians gaussians;
  gaussians.upload(test_context(), scene.gaussians);
  RenderOutput output;
  rasterizer.forward_pixels(gaussians, scene.camera, scene.T_world_camera, request, pixels, output);
  EXPECT_EQ(output.width, static_cast<int>(pixels.size()));
  EXPECT_EQ(output.height, 1);
  return {output.color.download(), output.depth.download(), output.alpha.download(), output.sigma.download()};
}

std::vector<float> picked(const std::vector<float>& image, const Camera& camera, const std::vector<cv::Point>& pixels) {
  std::vector<float> values;
  const auto plane = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  for (std::size_t begin = 0; begin < image.size(); begin += plane) {
    for (const cv::Point& p : pixels)
      values.push_back(image[begin + static_cast<std::size_t>(p.y) * static_cast<std::size_t>(camera.width) +
                             static_cast<std::size_t>(p.x)]);
  }
  return values;
}

void expect_bits_of_whole_image(Rasterizer& rasterizer, const RasterScene& scene, const RenderRequest& request,
                                const std::vector<cv::Point>& pixels) {
  const HostImages some = render_pixels(rasterizer, scene, request, pixels);
  const std::size_t pairs_of_some = rasterizer.pairs();
  const HostImages whole = render(rasterizer, test_context(), scene, request);
  EXPECT_LE(pairs_of_some, rasterizer.pairs());
  EXPECT_EQ(some.color, picked(whole.color, scene.camera, pixels));
  EXPECT_EQ(some.depth, picked(whole.depth, scene.camera, pixels));
  EXPECT_EQ(some.alpha, picked(whole.alpha, scene.camera, pixels));
  EXPECT_EQ(some.sigma, picked(whole.sigma, scene.camera, pixels));
}

TEST_P(RasterPixels, AreThoseOfTheWholeImageToTheBit) {
  for (const bool compensated : {false, true}) {
    Rasterizer rasterizer = make_rasterizer(GetParam(), compensated);
    for (const RasterScene& scene : all_scenes()) {
      for (const DepthMode mode : {DepthMode::expected, DepthMode::median, DepthMode::blended}) {
        SCOPED_TRACE(scene.name + " mode " + std::to_string(static_cast<int>(mode)));
        RenderRequest request;
        request.color = true;
        request.sigma = mode == DepthMode::expected;
        request.depth_mode = mode;
        expect_bits_of_whole_image(rasterizer, scene, request, some_pixels(scene.camera, 20, 1));
        expect_bits_of_whole_image(rasterizer, scene, request, {{18, 13}});
      }
    }
  }
}

// So large that most Gaussians reach no wanted pixel and several work-items select them.
TEST_P(RasterPixels, MostGaussiansAreLeftOut) {
  RasterScene scene = overlapping_scene(9000, 0, 21);
  for (float& s : scene.gaussians.log_scales) s -= 3.0F;
  scene.camera = {370, 290, 400.0, 430.0, 173.0, 149.0};
  Rasterizer rasterizer = make_rasterizer(GetParam());
  RenderRequest request;
  request.sigma = true;
  const std::vector<cv::Point> pixels = some_pixels(scene.camera, 60, 2);
  expect_bits_of_whole_image(rasterizer, scene, request, pixels);
  const std::size_t all = rasterizer.pairs();
  const HostImages some = render_pixels(rasterizer, scene, request, pixels);
  EXPECT_LT(rasterizer.tile_counts().size(), 4500U);
  EXPECT_LT(rasterizer.pairs(), all / 2);
  EXPECT_GT(std::set<float>(some.depth.begin(), some.depth.end()).size(), 30U) << "the pixels show nothing";
}

TEST_P(RasterPixels, EveryPixelWantedIsTheWholeImage) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  const RasterScene scene = overlapping_scene(400, 3, 1);
  std::vector<cv::Point> pixels;
  for (int y = 0; y < scene.camera.height; ++y) {
    for (int x = 0; x < scene.camera.width; ++x) pixels.push_back({x, y});
  }
  RenderRequest request;
  request.color = true;
  expect_bits_of_whole_image(rasterizer, scene, request, pixels);
}

TEST_P(RasterPixels, NoPixelsGiveEmptyImages) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  const HostImages images = render_pixels(rasterizer, overlapping_scene(90, 1, 2), {}, {});
  EXPECT_TRUE(images.depth.empty());
  EXPECT_TRUE(images.alpha.empty());
}

TEST_P(RasterPixels, OutsideTheImageIsRefused) {
  Rasterizer rasterizer = make_rasterizer(GetParam());
  const RasterScene scene = single_scene();
  DeviceGaussians gaussians, gradients;
  gaussians.upload(test_context(), scene.gaussians);
  RenderOutput output;
  for (const cv::Point& p : {cv::Point(-1, 0), cv::Point(0, -1), cv::Point(37, 0), cv::Point(0, 29)}) {
    EXPECT_THROW(rasterizer.forward_pixels(gaussians, scene.camera, scene.T_world_camera, {}, {{0, 0}, p}, output),
                 InputError);
  }
  rasterizer.forward_pixels(gaussians, scene.camera, scene.T_world_camera, {}, {{0, 0}}, output);
  EXPECT_THROW(rasterizer.backward(gaussians, {}, gradients), InputError);
}

INSTANTIATE_TEST_SUITE_P(Shells, RasterPixels, testing::Values(Shell::tile, Shell::pixel),
                         [](const auto& shell) { return shell.param == Shell::tile ? "Tile" : "Pixel"; });

}  // namespace
}  // namespace odosplat
