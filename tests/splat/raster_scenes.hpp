// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/compute/context.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "tests/splat/reference/raster_reference.hpp"

namespace odosplat {

/// A scene for the rasteriser's tests.
struct RasterScene {
  std::string name;
  Gaussians gaussians;
  Camera camera;
  SE3 T_world_camera;
};

/// 37 x 29 pixels: not a multiple of the tile's size in either direction.
Camera odd_camera();
SE3 oblique_pose();

/// `n` Gaussians in front of the camera, many at each pixel, of various shapes, opacities and colours.
RasterScene overlapping_scene(std::size_t n, int sh_degree, std::uint64_t seed);
/// Gaussians behind the camera, beside the image, across the camera's plane and nearer than the near depth.
RasterScene surrounding_scene();
/// Needles and thin discs, some seen edge-on, up to 1000 times longer than thick.
RasterScene needle_scene();
RasterScene empty_scene();
RasterScene single_scene();
std::vector<RasterScene> all_scenes();

/// Rendered images, copied to the host.
struct HostImages {
  std::vector<float> color, depth, alpha, sigma;
};
HostImages render(Rasterizer& rasterizer, const compute::Context& context, const RasterScene& scene,
                  const RenderRequest& request);

/// The device that all tests use.
const compute::Context& test_context();
Rasterizer make_rasterizer(Shell shell, bool compensated = false, DepthKind kind = DepthKind::automatic,
                           BlendOrder order = BlendOrder::depth);

/// Number of pixels of b that differ from a by more than tolerance (absolute), among those whose margin is above
/// `band`.
std::size_t count_different(const std::vector<double>& a, const std::vector<float>& b,
                            const std::vector<double>& margin, double band, double tolerance);

}  // namespace odosplat
