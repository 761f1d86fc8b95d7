// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/view_weights.hpp"

#include <algorithm>

namespace odosplat {

ViewWeights::ViewWeights(const compute::Context& context, const Gaussians& gaussians, const RasterizerOptions& options)
    : context_(context), rasterizer_(context, options) {
  gaussians.check();
  Gaussians gray = gaussians;
  gray.sh_degree = 0;
  gray.sh.assign(3 * gray.size(), 0.0F);  // 0.5: where colours are not clamped, and so have a gradient
  gaussians_.upload(context, gray);
}

std::vector<float> ViewWeights::in(const Camera& camera, const SE3& T_world_camera) {
  std::vector<float> weights(gaussians_.size(), 0.0F);
  if (weights.empty()) return weights;
  RenderRequest request;
  request.color = true;
  request.depth = false;
  request.sh_degree = 0;
  rasterizer_.forward(gaussians_, camera, T_world_camera, request, output_);
  const std::size_t pixels = output_.alpha.size();
  if (ones_.color.size() != 3 * pixels) {
    std::vector<float> red(3 * pixels, 0.0F);
    std::fill_n(red.begin(), pixels, 1.0F / sh_constant);
    ones_.color = compute::Buffer<float>(context_, red);
  }
  rasterizer_.backward(gaussians_, ones_, gradients_);
  const std::vector<float> gradients = gradients_.sh.download();
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = gradients[3 * i];
  return weights;
}

std::vector<float> largest_weights(const compute::Context& context, const Gaussians& gaussians,
                                   const RasterizerOptions& options, const std::vector<EditView>& views,
                                   const ViewNotice& notice) {
  ViewWeights weights(context, gaussians, options);
  std::vector<float> largest(gaussians.size(), 0.0F);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::vector<float> here = weights.in(views[k].camera, views[k].T_world_camera);
    for (std::size_t i = 0; i < here.size(); ++i) largest[i] = std::max(largest[i], here[i]);
    if (notice) notice(k + 1);
  }
  return largest;
}

}  // namespace odosplat
