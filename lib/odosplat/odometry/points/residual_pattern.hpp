// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>

#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

/// DSO's residual pattern: offsets [px] around a point; 8 pixels, so that two SIMD registers hold them.
inline constexpr int pattern_size = 8;
inline constexpr std::array<std::array<int, 2>, pattern_size> pattern = {
    {{0, -2}, {-1, -1}, {1, -1}, {-2, 0}, {0, 0}, {2, 0}, {-1, 1}, {0, 2}}};

/// Grey values around a pixel, and their gradient-dependent weights c^2 / (c^2 + |gradient|^2), as DSO has them; c =
/// gradient_weight [grey/px]. The pattern must lie within the image.
inline void sample_pattern(const GradientImage& gradient, const cv::Point& pixel, double gradient_weight,
                           float (&intensity)[pattern_size], float (&weight)[pattern_size]) {
  const auto c2 = static_cast<float>(gradient_weight * gradient_weight);
  for (std::size_t k = 0; k < pattern_size; ++k) {
    const float* g = gradient.ptr<float>(pixel.y + pattern[k][1]) + 4 * (pixel.x + pattern[k][0]);
    intensity[k] = g[0];
    weight[k] = c2 / (c2 + g[3]);
  }
}

}  // namespace odosplat
