// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace odosplat {

inline bool same_bytes(const cv::Mat3b& a, const cv::Mat3b& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

inline bool is_white(const cv::Vec3b& pixel) { return pixel == cv::Vec3b(255, 255, 255); }

inline bool near_color(const cv::Vec3b& a, const cv::Vec3b& b, int tolerance) {
  return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance && std::abs(a[2] - b[2]) <= tolerance;
}

/// Bounding box of all pixels that are not white.
inline cv::Rect ink_box(const cv::Mat3b& image) {
  cv::Rect box;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (!is_white(image(y, x))) box |= cv::Rect(x, y, 1, 1);
    }
  }
  return box;
}

inline int count_near(const cv::Mat3b& image, const cv::Vec3b& color, int tolerance) {
  return static_cast<int>(
      std::count_if(image.begin(), image.end(), [&](const auto& p) { return near_color(p, color, tolerance); }));
}

/// Mean position of the pixels near a colour; NaN if there are none.
inline cv::Point2d center_of(const cv::Mat3b& image, const cv::Vec3b& color, int tolerance) {
  cv::Point2d sum(0.0, 0.0);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (near_color(image(y, x), color, tolerance)) sum += cv::Point2d(x, y);
    }
  }
  return sum / static_cast<double>(count_near(image, color, tolerance));
}

/// Whether the outermost `margin` pixels on all sides are white.
inline bool margins_are_white(const cv::Mat3b& image, int margin) {
  const cv::Rect box = ink_box(image);
  return box.empty() ||
         (box.x >= margin && box.y >= margin && box.br().x <= image.cols - margin && box.br().y <= image.rows - margin);
}

}  // namespace odosplat
