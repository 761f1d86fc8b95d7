// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <opencv2/imgproc.hpp>

#include "apps/python/arrays.hpp"

namespace odosplat::python {

ColorImage color_of(const RawImage& image) {
  cv::Mat rgb = image.pixels;
  if (image.is_gray()) {
    cv::cvtColor(image.pixels, rgb, cv::COLOR_GRAY2RGB);
  } else if (image.order == ColorOrder::bgr) {
    cv::cvtColor(image.pixels, rgb, cv::COLOR_BGR2RGB);
  }
  ColorImage color;
  rgb.convertTo(color, CV_32F, rgb.depth() == CV_8U ? 1.0 / 255.0 : 1.0);
  return color;
}

GrayImage gray_of(const RawImage& image) {
  if (!image.is_gray() || image.pixels.depth() == CV_8U) return to_gray(color_of(image));
  return image.pixels;
}

}  // namespace odosplat::python
