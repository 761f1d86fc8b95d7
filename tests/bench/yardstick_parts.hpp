// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The pieces of the yardstick, each compiled for AVX2 and FMA.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/constants.h"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat::yard {

/// Camera and pose for the projection; fields as in projection.cl.
struct View {
  std::array<float, 12> pose{};  // rotation world to camera row by row, translation
  std::array<float, 8> lens{};
  int width = 0, height = 0, columns = 0, rows = 0;  // [px], tiles
};

/// As in raster_common.cl: u, v, A, B, C, log2 opacity, depth, unused, slope u, slope v, unused, unused.
struct alignas(16) Splat {
  std::array<float, 12> value;
};

/// Number of Gaussians that a thread projects at a time, and the tiles they reach, Gaussian by Gaussian.
constexpr std::size_t part_size = 2048;
struct Part {
  std::vector<std::uint32_t> tiles;
};

/// Projects Gaussians [begin, end), at most part_size of them: computes splats, depth keys (~0: not drawn) and `part`
/// with their tiles, where first[g] is the place of Gaussian g's first tile and count[g] their number.
void project_part(const Gaussians& gaussians, const View& view, std::size_t begin, std::size_t end, Splat* splats,
                  std::uint32_t* keys, std::uint32_t* first, std::uint32_t* count, Part& part);

/// Composites one tile's list (Gaussians from near to far) into the depth image.
void composite_tile(const View& view, int tile, const std::uint32_t* list, std::size_t size, const Splat* splats,
                    float* depth);

}  // namespace odosplat::yard
