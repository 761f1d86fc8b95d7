// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/splat/device_gaussians.hpp"
#include "odosplat/splat/rasterizer.hpp"

namespace odosplat {

struct GaussianViewOptions {
  DepthMode depth_mode = DepthMode::expected;
  float min_alpha = 0.5F;       // pixels that the map covers less have no depth, 0..1
  float sigma_floor = 0.003F;   // share of depth that its standard deviation is never below, >= 0
  float sigma_slope_px = 0.5F;  // error in the image plane that a sloped surface turns into one of depth [px], >= 0
  RasterizerOptions rasterizer;

  /// Throws InputError naming the field.
  void check() const;
};

/// A trained map of Gaussians, looked at from any pose.
/// depth [m] as depth_mode says, 0 where alpha < min_alpha. color 0..1 on black, not divided by alpha.
/// sigma [m], the root of a sum of squares: the spread of the Gaussians along the ray (sqrt(sum w (z - depth)^2 / sum
/// w); with depth mode expected only: the others have no mean to spread around), sigma_slope_px times the slope of
/// depth in the image [m/px] (central differences between pixels with depth), and sigma_floor times depth. Source: the
/// pieces are those of the project's design notes: what a tracker needs to weigh a depth by. The Gaussians may be none:
/// images of zeros. Frame: world of the Gaussians. Throws InputError for bad options, Gaussians or camera. Contract of
/// MapView otherwise.
class GaussianView : public MapView {
 public:
  GaussianView(const compute::Context& context, const Gaussians& gaussians, const GaussianViewOptions& options = {});

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  /// Composites those pixels only (Rasterizer::forward_pixels). sigma is without the term of the slope.
  ViewImages render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                           const std::vector<cv::Point>& pixels) override;
  std::string name() const override { return "gaussian"; }

 private:
  RenderRequest raster_request(const ViewRequest& request) const;
  ColorImage download_color(int height, int width);

  GaussianViewOptions options_;
  DeviceGaussians gaussians_;
  Rasterizer rasterizer_;
  RenderOutput output_;
  std::vector<float> planes_;
};

}  // namespace odosplat
