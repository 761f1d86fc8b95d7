// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/frame.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"

namespace odosplat {

Brightness relative_brightness(const Brightness& target, const Brightness& host) {
  const double a = target.a - host.a;
  return {a, target.b - std::exp(a) * host.b};
}

Brightness compose_brightness(const Brightness& relative, const Brightness& host) {
  return {host.a + relative.a, relative.b + std::exp(relative.a) * host.b};
}

void check_size(const Camera& camera, const GrayImage& image) {
  require(image.cols == camera.width && image.rows == camera.height, "image",
          std::to_string(camera.width) + "x" + std::to_string(camera.height) + " as the camera says, is " +
              std::to_string(image.cols) + "x" + std::to_string(image.rows));
}

FramePyramid build_frame_pyramid(const Camera& camera, const GrayImage& gray, double smoothing) {
  constexpr int max_levels = 6;
  constexpr int min_side = 30;
  check_size(camera, gray);
  FramePyramid pyramid;
  GrayImage full = gray;
  if (smoothing > 0.0) {
    GrayImage smooth;
    cv::GaussianBlur(gray, smooth, cv::Size(5, 5), smoothing, smoothing, cv::BORDER_REPLICATE);
    full = smooth;
  }
  pyramid.gray.push_back(full);
  pyramid.cameras.push_back(camera);
  while (pyramid.levels() < max_levels &&
         std::min(pyramid.gray.back().rows, pyramid.gray.back().cols) / 2 >= min_side) {
    pyramid.gray.push_back(halve(pyramid.gray.back()));
    pyramid.cameras.push_back(camera.level(pyramid.levels() - 1));
  }
  return pyramid;
}

GradientImage build_gradient(const GrayImage& gray) {
  GradientImage out(gray.rows, gray.cols);
  for (int y = 0; y < gray.rows; ++y) {
    const bool inner_row = y > 0 && y < gray.rows - 1;
    const float* above = gray[inner_row ? y - 1 : y];
    const float* row = gray[y];
    const float* below = gray[inner_row ? y + 1 : y];
    float* o = out.ptr<float>(y);
    for (int x = 0; x < gray.cols; ++x, o += 4) {
      const bool inner = inner_row && x > 0 && x < gray.cols - 1;
      const float gx = inner ? 0.5F * (row[x + 1] - row[x - 1]) : 0.0F;
      const float gy = inner ? 0.5F * (below[x] - above[x]) : 0.0F;
      o[0] = row[x];
      o[1] = gx;
      o[2] = gy;
      o[3] = gx * gx + gy * gy;
    }
  }
  return out;
}

std::vector<GradientImage> build_gradients(const FramePyramid& pyramid) {
  std::vector<GradientImage> gradients;
  gradients.reserve(pyramid.gray.size());
  for (const GrayImage& gray : pyramid.gray) gradients.push_back(build_gradient(gray));
  return gradients;
}

}  // namespace odosplat
