// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/image.hpp"

#include <opencv2/imgproc.hpp>

namespace odosplat {
namespace {

template <typename Image>
Image halve_by_means(const Image& image) {
  using Pixel = typename Image::value_type;
  Image half(image.rows / 2, image.cols / 2);
  for (int y = 0; y < half.rows; ++y) {
    const Pixel* r0 = image[2 * y];
    const Pixel* r1 = image[2 * y + 1];
    Pixel* out = half[y];
    for (int x = 0; x < half.cols; ++x) out[x] = 0.25F * (r0[2 * x] + r0[2 * x + 1] + r1[2 * x] + r1[2 * x + 1]);
  }
  return half;
}

}  // namespace

GrayImage to_gray(const ColorImage& color) {
  GrayImage gray;
  if (!color.empty()) cv::cvtColor(color, gray, cv::COLOR_RGB2GRAY);
  return gray;
}

GrayImage halve(const GrayImage& image) { return halve_by_means(image); }
ColorImage halve(const ColorImage& image) { return halve_by_means(image); }

std::vector<GrayImage> build_pyramid(const GrayImage& image, int levels) {
  std::vector<GrayImage> pyramid{image};
  while (static_cast<int>(pyramid.size()) < levels && pyramid.back().rows >= 2 && pyramid.back().cols >= 2) {
    pyramid.push_back(halve(pyramid.back()));
  }
  return pyramid;
}

}  // namespace odosplat
