// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/compute/context.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"

namespace odosplat {

/// A view from which a map is looked at, to decide what of it is kept.
struct EditView {
  Camera camera;
  SE3 T_world_camera;
  std::function<DepthImage()> depth{};  // measured depth [m], 0: none; no function, or an empty image: not measured
};

/// Called with the number of views that are done; may throw to stop.
using ViewNotice = std::function<void(std::size_t done)>;

/// How much of images Gaussians make up.
/// The weight of a Gaussian in a view [px] is the sum over the pixels of its blending weights, opacity at the pixel
/// times the transmittance of what lies before it: 0 for one that is outside the image or hidden. It is the gradient of
/// the sum of all pixels of an image in which every Gaussian has colour 1, so the rasteriser's own rules (tiles,
/// cut-offs, order) hold. Deterministic. Not thread safe.
class ViewWeights {
 public:
  /// options: those of the map's header.
  ViewWeights(const compute::Context& context, const Gaussians& gaussians, const RasterizerOptions& options);

  /// Weights [N] in one view. Errors as Rasterizer.
  std::vector<float> in(const Camera& camera, const SE3& T_world_camera);

 private:
  compute::Context context_;
  DeviceGaussians gaussians_;  // all grey
  Rasterizer rasterizer_;
  RenderOutput output_;
  OutputGradients ones_;
  DeviceGaussians gradients_;
};

/// For every Gaussian its largest weight [px] in any of the views.
std::vector<float> largest_weights(const compute::Context& context, const Gaussians& gaussians,
                                   const RasterizerOptions& options, const std::vector<EditView>& views,
                                   const ViewNotice& notice = {});

}  // namespace odosplat
