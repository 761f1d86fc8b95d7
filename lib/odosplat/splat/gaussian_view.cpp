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

}  // namespace

void GaussianViewOptions::check() const {
  require(min_alpha >= 0.0F && min_alpha <= 1.0F, "min_alpha", "in 0..1");
  sigma.check();
  rasterizer.check();
}

namespace {

GaussianViewOptions options_of(const MapHeader& header, DepthMode depth_mode) {
  GaussianViewOptions options;
  options.depth_mode = depth_mode;
  options.sigma = header.sigma.value_or(SigmaModel());
  options.rasterizer = header.rasterizer;
  return options;
}

}  // namespace

DepthMode depth_mode(const std::string& name) {
  if (name == "expected") return DepthMode::expected;
  if (name == "median") return DepthMode::median;
  if (name == "blended") return DepthMode::blended;
  if (name == "surface") return DepthMode::surface;
  throw InputError("depth", "must be expected, median, blended or surface, is \"" + name + "\"");
}

GaussianView::GaussianView(const compute::Context& context, const Map& map, DepthMode depth_mode)
    : GaussianView(context, map.gaussians, options_of(map.header, depth_mode)) {}

GaussianView::GaussianView(const compute::Context& context, const Gaussians& gaussians,
                           const GaussianViewOptions& options)
    : options_((options.check(), options)), rasterizer_(context, options.rasterizer) {
  gaussians_.upload(context, gaussians);
}

RenderRequest GaussianView::raster_request(const ViewRequest& request) const {
  RenderRequest wanted;
  wanted.color = request.color;
  wanted.depth_mode = options_.depth_mode;
  wanted.sigma = options_.depth_mode == DepthMode::expected || options_.depth_mode == DepthMode::surface;
  wanted.sigma_model = options_.sigma;
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

  return take(camera.height, camera.width, request);
}

ViewImages GaussianView::render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                                       const std::vector<cv::Point>& pixels) {
  const RenderRequest wanted = raster_request(request);
  rasterizer_.forward_pixels(gaussians_, camera, T_world_camera, wanted, pixels, output_);
  if (pixels.empty()) return {};
  return take(1, output_.width, request);
}

ViewImages GaussianView::take(int height, int width, const ViewRequest& request) {
  ViewImages images;
  images.depth = download(output_.depth, height, width);
  images.sigma = output_.sigma.empty() ? cv::Mat1f(options_.sigma.depth_share * images.depth)
                                       : download(output_.sigma, height, width);
  const cv::Mat1f alpha = download(output_.alpha, height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!(alpha(y, x) >= options_.min_alpha)) images.depth(y, x) = 0.0F;
      if (!(images.depth(y, x) > 0.0F)) images.sigma(y, x) = 0.0F;
    }
  }
  if (request.color) images.color = download_color(height, width);
  if (request.alpha) images.alpha = alpha;
  return images;
}

}  // namespace odosplat
