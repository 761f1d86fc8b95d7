// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/patterns.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/content/noise.hpp"
#include "odosplat/synth/content/pattern_parts.hpp"

namespace odosplat {

ColorImage paint(int width, int height, const std::function<Eigen::Vector3f(float x, float y)>& color) {
  ColorImage image(height, width);
  parallel_for(height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        const Eigen::Vector3f c = color((static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                                        (static_cast<float>(y) + 0.5F) / static_cast<float>(height));
        for (int i = 0; i < 3; ++i) image(y, x)[i] = std::clamp(c[i], 0.0F, 1.0F);
      }
    }
  });
  return image;
}

ColorImage checker_pattern(int size, int cells, const Eigen::Vector3f& dark, const Eigen::Vector3f& bright) {
  const auto n = static_cast<float>(cells);
  return paint(size, size, [=](float x, float y) {
    return (static_cast<int>(x * n) + static_cast<int>(y * n)) % 2 == 0 ? dark : bright;
  });
}

ColorImage marble_pattern(int size, int cells, const Eigen::Vector3f& low, const Eigen::Vector3f& middle,
                          const Eigen::Vector3f& high, std::uint32_t seed) {
  const auto n = static_cast<float>(cells);
  return paint(size, size, [=](float x, float y) {
    const float s = std::clamp(0.5F + 1.6F * fractal_noise(x * n, y * n, cells, 6, 0.65F, seed), 0.0F, 1.0F);
    return s < 0.5F ? mix(low, middle, 2.0F * s) : mix(middle, high, 2.0F * s - 1.0F);
  });
}

}  // namespace odosplat
