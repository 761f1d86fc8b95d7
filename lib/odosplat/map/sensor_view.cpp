// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/sensor_view.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

void SensorViewOptions::check() const {
  require(std::isfinite(sigma_constant) && sigma_constant > 0.0, "sigma_constant", "positive [m]");
  require(std::isfinite(sigma_square) && sigma_square >= 0.0, "sigma_square", "at least 0 [1/m]");
  require(std::isfinite(nearest) && nearest >= 0.0, "nearest", "at least 0 [m]");
}

SensorView::SensorView(const SensorViewOptions& options) : options_((options.check(), options)) {}

void SensorView::set_depth(const DepthImage& depth) {
  depth_ = depth.clone();
  for (float& z : depth_) {
    if (!(z > 0.0F) || !std::isfinite(z)) z = 0.0F;
  }
}

ViewImages SensorView::render(const Camera& camera, const SE3& /*T_world_camera*/, const ViewRequest& request) {
  camera.check();
  const cv::Size size(camera.width, camera.height);
  if (!depth_.empty() && depth_.size() != size) {
    throw InputError("depth image", "is " + std::to_string(depth_.cols) + "x" + std::to_string(depth_.rows) +
                                        ", the camera " + std::to_string(size.width) + "x" +
                                        std::to_string(size.height));
  }
  ViewImages images;
  images.depth = depth_.empty() ? DepthImage(DepthImage::zeros(size)) : DepthImage(depth_.clone());
  images.sigma = cv::Mat1f::zeros(size);
  if (request.alpha) images.alpha = cv::Mat1f::zeros(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double z = images.depth(y, x);
      if (z <= 0.0) continue;
      images.sigma(y, x) = static_cast<float>(options_.sigma(z));
      if (request.alpha) images.alpha(y, x) = 1.0F;
    }
  }
  return images;
}

}  // namespace odosplat
