// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace odosplat {

/// Colour image, channels in the order R, G, B, values 0..1 as stored in the file (no gamma applied).
using ColorImage = cv::Mat3f;
/// Grey image, values 0..1.
using GrayImage = cv::Mat1f;
/// z along the optical axis [m]; 0 = no depth.
using DepthImage = cv::Mat1f;

/// ITU-R 601 luma: 0.299 R + 0.587 G + 0.114 B.
GrayImage to_gray(const ColorImage& color);

/// Half the size by 2x2 means; an odd last row or column is dropped, as Camera::level does.
GrayImage halve(const GrayImage& image);
ColorImage halve(const ColorImage& image);

/// Levels 0 (the image itself, shared) .. levels - 1; fewer if the next level would have zero size.
std::vector<GrayImage> build_pyramid(const GrayImage& image, int levels);

/// Bilinear value at (u, v). Precondition, not checked: 0 <= u <= cols - 1 and 0 <= v <= rows - 1.
inline float bilinear(const GrayImage& image, float u, float v) {
  int x = static_cast<int>(u);
  int y = static_cast<int>(v);
  x = x < image.cols - 1 ? x : image.cols - 2;
  y = y < image.rows - 1 ? y : image.rows - 2;
  const float a = u - static_cast<float>(x);
  const float b = v - static_cast<float>(y);
  const float* r0 = image.ptr<float>(y) + x;
  const float* r1 = image.ptr<float>(y + 1) + x;
  return (1.0F - b) * ((1.0F - a) * r0[0] + a * r0[1]) + b * ((1.0F - a) * r1[0] + a * r1[1]);
}

}  // namespace odosplat
