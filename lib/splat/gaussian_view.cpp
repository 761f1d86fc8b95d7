// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/gaussian_view.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

cv::Mat1f download(const compute::Buffer<float>& buffer, int height, int width) {
  cv::Mat1f image(height, width);
  buffer.download(image.ptr<float>(), image.total());
  return image;
}

/// Slope of depth along one axis from a pixel and its two neighbours [m/px]; 0 = no depth.
float slope(float before, float here, float after) {
  if (before > 0.0F && after > 0.0F) return 0.5F * (after - before);
  if (after > 0.0F) return after - here;
  if (before > 0.0F) return here - before;
  return 0.0F;
}

}  // namespace

void GaussianViewOptions::check() const {
  require(min_alpha >= 0.0F && min_alpha <= 1.0F, "min_alpha", "in 0..1");
  require(sigma_floor >= 0.0F && std::isfinite(sigma_floor), "sigma_floor", "at least 0");
  require(sigma_slope_px >= 0.0F && std::isfinite(sigma_slope_px), "sigma_slope_px", "at least 0");
  rasterizer.check();
}

GaussianView::GaussianView(const compute::Context& context, const Gaussians& gaussians,
                           const GaussianViewOptions& options)
    : options_((options.check(), options)), rasterizer_(context, options.rasterizer) {
  gaussians_.upload(context, gaussians);
}

RenderRequest GaussianView::raster_request(const ViewRequest& request) const {
  RenderRequest wanted;
  wanted.color = request.color;
  wanted.depth_mode = options_.depth_mode;
  wanted.sigma = options_.depth_mode == DepthMode::expected;
  wanted.sh_degree = gaussians_.sh_degree;
  return wanted;
}

ColorImage GaussianView::download_color(int height, int width) {
  const auto plane = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  planes_.resize(3 * plane);
  output_.color.download(planes_.data(), planes_.size());
  ColorImage color(height, width);
  cv::Vec3f* pixels = color[0];
  for (std::size_t i = 0; i < plane; ++i)
    for (std::size_t c = 0; c < 3; ++c) pixels[i][static_cast<int>(c)] = std::clamp(planes_[c * plane + i], 0.0F, 1.0F);
  return color;
}

ViewImages GaussianView::render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) {
  const RenderRequest wanted = raster_request(request);
  rasterizer_.forward(gaussians_, camera, T_world_camera, wanted, output_);

  ViewImages images;
  images.depth = download(output_.depth, camera.height, camera.width);
  const cv::Mat1f alpha = download(output_.alpha, camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x)
      if (!(alpha(y, x) >= options_.min_alpha)) images.depth(y, x) = 0.0F;

  const cv::Mat1f spread = wanted.sigma ? download(output_.sigma, camera.height, camera.width)
                                        : cv::Mat1f(camera.height, camera.width, 0.0F);
  images.sigma = cv::Mat1f(camera.height, camera.width, 0.0F);
  for (int y = 0; y < camera.height; ++y) {
    const float* row = images.depth[y];
    const float* above = y > 0 ? images.depth[y - 1] : nullptr;
    const float* below = y + 1 < camera.height ? images.depth[y + 1] : nullptr;
    for (int x = 0; x < camera.width; ++x) {
      const float depth = row[x];
      if (depth <= 0.0F) continue;
      const float du = slope(x > 0 ? row[x - 1] : 0.0F, depth, x + 1 < camera.width ? row[x + 1] : 0.0F);
      const float dv = slope(above != nullptr ? above[x] : 0.0F, depth, below != nullptr ? below[x] : 0.0F);
      const float sloped = options_.sigma_slope_px * std::hypot(du, dv);
      const float least = options_.sigma_floor * depth;
      images.sigma(y, x) = std::sqrt(spread(y, x) * spread(y, x) + sloped * sloped + least * least);
    }
  }

  if (request.color) images.color = download_color(camera.height, camera.width);
  if (request.alpha) images.alpha = alpha;
  return images;
}

ViewImages GaussianView::render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                                       const std::vector<cv::Point>& pixels) {
  const RenderRequest wanted = raster_request(request);
  rasterizer_.forward_pixels(gaussians_, camera, T_world_camera, wanted, pixels, output_);
  if (pixels.empty()) return {};
  const int count = output_.width;
  ViewImages images;
  images.depth = download(output_.depth, 1, count);
  images.sigma = cv::Mat1f(1, count, 0.0F);
  const cv::Mat1f alpha = download(output_.alpha, 1, count);
  const cv::Mat1f spread = wanted.sigma ? download(output_.sigma, 1, count) : cv::Mat1f(1, count, 0.0F);
  for (int i = 0; i < count; ++i) {
    float& depth = images.depth(0, i);
    if (!(alpha(0, i) >= options_.min_alpha)) depth = 0.0F;
    if (depth > 0.0F) images.sigma(0, i) = std::hypot(spread(0, i), options_.sigma_floor * depth);
  }
  if (request.color) images.color = download_color(1, count);
  if (request.alpha) images.alpha = alpha;
  return images;
}

}  // namespace odosplat
