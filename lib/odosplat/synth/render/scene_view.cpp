// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/scene_view.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {

void SceneViewOptions::check() const {
  require(samples >= 1 && samples <= 64, "scene_view.samples", "in 1..64");
  require(sigma > 0.0F, "scene_view.sigma", "positive");
}

SceneView::SceneView(std::shared_ptr<const Scene> scene, const SceneViewOptions& options)
    : scene_(std::move(scene)), options_(options) {
  options_.check();
  require(scene_ != nullptr, "scene", "given");
}

ViewImages SceneView::render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) {
  RenderOptions options;
  options.samples = options_.samples;
  options.color = request.color;
  Rendering rendering = odosplat::render(*scene_, camera, T_world_camera, options);
  ViewImages images;
  images.depth = rendering.depth;
  images.color = rendering.color;
  images.sigma = cv::Mat1f::zeros(camera.height, camera.width);
  images.sigma.setTo(options_.sigma, images.depth > 0.0F);
  if (request.alpha) {
    images.alpha = cv::Mat1f::zeros(camera.height, camera.width);
    images.alpha.setTo(1.0F, images.depth > 0.0F);
  }
  return images;
}

}  // namespace odosplat
