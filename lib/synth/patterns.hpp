// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Images for textures, stored colours 0..1. All are deterministic in their seed, and tile without a seam in both
/// directions where it says so. Sizes in pixels, at least 1.

/// width x height image of color(x, y) with x, y in [0, 1) at pixel centres; clamped to 0..1. Runs on all threads.
ColorImage paint(int width, int height, const std::function<Eigen::Vector3f(float x, float y)>& color);

/// cells x cells squares of two colours. Tiles if cells is even.
ColorImage checker_pattern(int size, int cells, const Eigen::Vector3f& dark, const Eigen::Vector3f& bright);

/// Strong contrasts at all scales, for tests: fractal noise between three colours. cells: of the coarsest scale. Tiles.
ColorImage marble_pattern(int size, int cells, const Eigen::Vector3f& low, const Eigen::Vector3f& middle,
                          const Eigen::Vector3f& high, std::uint32_t seed);

}  // namespace odosplat
