// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/splat/map.hpp"
#include "odosplat/splat/raster/device_gaussians.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/sigma_model.hpp"

namespace odosplat {

struct GaussianViewOptions {
  DepthMode depth_mode = DepthMode::surface;
  float min_alpha = 0.5F;  // pixels that the map covers less have no depth, 0..1
  SigmaModel sigma;
  RasterizerOptions rasterizer;

  /// Throws InputError naming the field.
  void check() const;
};

/// "expected", "median", "blended" or "surface"; InputError else.
DepthMode depth_mode(const std::string& name);

/// A trained map of Gaussians, rendered from any pose.
/// depth [m] as depth_mode says, 0 where alpha < min_alpha. color 0..1 on black, not divided by alpha.
/// sigma [m] by the sigma model, 0 where depth is 0; for median and blended depth, which have no mean that a spread
/// could be taken around, only the model's share of depth. Without Gaussians all images are zero. Frame: world of the
/// Gaussians. Throws InputError for bad options, Gaussians or camera. Contract of MapView otherwise.
class GaussianView : public MapView {
 public:
  /// With the order of blending, the other options of rasterisation and the sigma model of the map's header.
  GaussianView(const compute::Context& context, const Map& map, DepthMode depth_mode = DepthMode::surface);
  /// Gaussians without a header, such as those in training.
  GaussianView(const compute::Context& context, const Gaussians& gaussians, const GaussianViewOptions& options);

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  /// Composites those pixels only (Rasterizer::forward_pixels). sigma lacks the term of the slope.
  ViewImages render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                           const std::vector<cv::Point>& pixels) override;
  std::string name() const override { return "gaussian"; }

 private:
  RenderRequest raster_request(const ViewRequest& request) const;
  ColorImage download_color(int height, int width);
  /// The images of the last forward call.
  ViewImages take(int height, int width, const ViewRequest& request);

  GaussianViewOptions options_;
  DeviceGaussians gaussians_;
  Rasterizer rasterizer_;
  RenderOutput output_;
  std::vector<float> planes_;
};

}  // namespace odosplat
