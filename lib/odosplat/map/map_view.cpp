// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/map_view.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {

ViewImages blank_images(const Camera& camera, const ViewRequest& request, bool colors) {
  const cv::Size size(camera.width, camera.height);
  ViewImages images;
  images.depth = DepthImage::zeros(size);
  images.sigma = cv::Mat1f::zeros(size);
  if (request.alpha) images.alpha = cv::Mat1f::zeros(size);
  if (request.color && colors) images.color = ColorImage(size, cv::Vec3f(0.0F, 0.0F, 0.0F));
  return images;
}
namespace {

template <typename T>
cv::Mat_<T> picked(const cv::Mat_<T>& image, const std::vector<cv::Point>& pixels) {
  if (image.empty()) return {};
  cv::Mat_<T> values(1, static_cast<int>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) values(0, static_cast<int>(i)) = image(pixels[i]);
  return values;
}

}  // namespace

ViewImages MapView::render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                                  const std::vector<cv::Point>& pixels) {
  for (const cv::Point& p : pixels) {
    if (p.x < 0 || p.x >= camera.width || p.y < 0 || p.y >= camera.height) {
      throw InputError("pixel " + std::to_string(p.x) + " " + std::to_string(p.y),
                       "outside the image of " + std::to_string(camera.width) + " x " + std::to_string(camera.height));
    }
  }
  if (pixels.empty()) return {};
  const ViewImages whole = render(camera, T_world_camera, request);
  return {picked(whole.depth, pixels), picked(whole.sigma, pixels), picked(whole.alpha, pixels),
          picked(whole.color, pixels)};
}

}  // namespace odosplat
