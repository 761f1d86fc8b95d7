// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// A tile is 16 blocks of 4 x 4 pixels, a block two vectors of eight. A splat is added to the blocks that it can reach
// and that are not finished. Within a block log2 alpha is computed from its value and gradient at the block's middle.
#if defined(__AVX2__) && defined(__FMA__)

#include <algorithm>
#include <bit>

#include "tests/bench/yardstick_parts.hpp"
#include "tests/bench/yardstick_simd.hpp"

namespace odosplat::yard {
namespace {

constexpr std::size_t blocks = 16;
constexpr std::size_t check_interval = 32;

struct Tile {
  f8 transmittance[blocks][2], depth[blocks][2];  // C arrays: as a template argument f8 would lose its alignment
};

unsigned unfinished(const Tile& t) {
  unsigned alive = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const f8 left = most(t.transmittance[i][0], t.transmittance[i][1]);
    if (bits(at_least(left, set(MIN_TRANSMITTANCE))) != 0) alive |= 1U << i;
  }
  return alive;
}

}  // namespace

void composite_tile(const View& view, int tile, const std::uint32_t* list, std::size_t size, const Splat* splats,
                    float* depth) {
  const int x0 = tile % view.columns * TILE_WIDTH, y0 = tile / view.columns * TILE_HEIGHT;
  // Offsets of the pixels from the middle of their block, and of the middles of blocks from the tile's first pixel.
  const f8 lx = _mm256_setr_ps(-1.5F, -0.5F, 0.5F, 1.5F, -1.5F, -0.5F, 0.5F, 1.5F);
  const f8 ly[2] = {_mm256_setr_ps(-1.5F, -1.5F, -1.5F, -1.5F, -0.5F, -0.5F, -0.5F, -0.5F),
                    _mm256_setr_ps(0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F)};
  const f8 middle_x = _mm256_setr_ps(1.5F, 5.5F, 9.5F, 13.5F, 1.5F, 5.5F, 9.5F, 13.5F);
  const f8 middle_y[2] = {_mm256_setr_ps(1.5F, 1.5F, 1.5F, 1.5F, 5.5F, 5.5F, 5.5F, 5.5F),
                          _mm256_setr_ps(9.5F, 9.5F, 9.5F, 9.5F, 13.5F, 13.5F, 13.5F, 13.5F)};
  Tile t;
  const f8 right = set(static_cast<float>(view.width - x0)), bottom = set(static_cast<float>(view.height - y0));
  for (std::size_t i = 0; i < blocks; ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      const f8 x = add(lx, set(static_cast<float>(i % 4) * 4.0F + 1.5F));
      const f8 y = add(ly[h], set(static_cast<float>(i / 4) * 4.0F + 1.5F));
      t.transmittance[i][h] = both(set(1.0F), both(below(x, right), below(y, bottom)));
      t.depth[i][h] = set(0.0F);
    }
  }
  unsigned alive = unfinished(t);
  alignas(32) std::array<float, blocks> middle_e, gradient_x, gradient_y, middle_ratio;
  for (std::size_t p = 0; p < size; ++p) {
    if (p + 8 < size) {
      const auto* ahead = reinterpret_cast<const char*>(splats + list[p + 8]);
      _mm_prefetch(ahead, _MM_HINT_T0);
      _mm_prefetch(ahead + 32, _MM_HINT_T0);
    }
    const std::array<float, 12>& s = splats[list[p]].value;
    const f8 A = set(s[2]), B = set(s[3]), C = set(s[4]), slope_u = set(s[8]), slope_v = set(s[9]), z = set(s[6]);
    const f8 offset_x = set(static_cast<float>(x0) - s[0]), offset_y = set(static_cast<float>(y0) - s[1]);
    unsigned reached = 0;
    for (std::size_t h = 0; h < 2; ++h) {
      const f8 dx = add(middle_x, offset_x), dy = add(middle_y[h], offset_y);
      const f8 ax = mul(A, dx), cy = mul(C, dy), q = fma(B, dy, ax);
      const f8 e = fnma(dx, q, fnma(dy, cy, set(s[5])));
      const f8 gx = add(ax, q), gy = fma(B, dx, add(cy, cy));
      const f8 bound = fma(set(1.5F), add(magnitude(gx), magnitude(gy)), e);
      reached |= static_cast<unsigned>(bits(at_least(bound, set(LOG2_MIN_ALPHA)))) << (8 * h);
      _mm256_store_ps(middle_e.data() + 8 * h, e);
      _mm256_store_ps(gradient_x.data() + 8 * h, gx);
      _mm256_store_ps(gradient_y.data() + 8 * h, gy);
      _mm256_store_ps(middle_ratio.data() + 8 * h, fnma(slope_u, dx, fnma(slope_v, dy, set(1.0F))));
    }
    reached &= alive;
    if (reached != 0) {
      f8 bend[2], tilt[2];
      for (std::size_t h = 0; h < 2; ++h) {
        bend[h] = fma(lx, fma(A, lx, mul(B, ly[h])), mul(C, mul(ly[h], ly[h])));
        tilt[h] = fma(slope_u, lx, mul(slope_v, ly[h]));
      }
      do {
        const auto i = static_cast<std::size_t>(std::countr_zero(reached));
        reached &= reached - 1;
        const f8 e0 = set(middle_e[i]), gx = set(gradient_x[i]), gy = set(gradient_y[i]), ratio0 = set(middle_ratio[i]);
        for (std::size_t h = 0; h < 2; ++h) {
          const f8 e = fnma(gx, lx, fnma(gy, ly[h], sub(e0, bend[h])));
          const f8 T = t.transmittance[i][h];
          const f8 counts = both(at_least(e, set(LOG2_MIN_ALPHA)), at_least(T, set(MIN_TRANSMITTANCE)));
          const f8 w = mul(both(least(exp2_short(e), set(MAX_ALPHA)), counts), T);
          const f8 ratio = most(sub(ratio0, tilt[h]), set(MIN_PLANE_RATIO));
          t.transmittance[i][h] = sub(T, w);
          t.depth[i][h] = fma(w, div(z, ratio), t.depth[i][h]);
        }
      } while (reached != 0);
    }
    if (p % check_interval == check_interval - 1) {
      alive = unfinished(t);
      if (alive == 0) break;
    }
  }
  alignas(32) std::array<float, 16> block;
  for (std::size_t i = 0; i < blocks; ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      const f8 T = t.transmittance[i][h], covered = sub(set(1.0F), T);
      _mm256_store_ps(block.data() + 8 * h, both(div(t.depth[i][h], covered), below(T, set(1.0F))));
    }
    const int x = x0 + static_cast<int>(i % 4) * 4, y = y0 + static_cast<int>(i / 4) * 4;
    for (int r = 0; r < std::min(4, view.height - y); ++r) {
      for (int c = 0; c < std::min(4, view.width - x); ++c)
        depth[static_cast<std::size_t>(y + r) * static_cast<std::size_t>(view.width) +
              static_cast<std::size_t>(x + c)] = block[static_cast<std::size_t>(4 * r + c)];
    }
  }
}

}  // namespace odosplat::yard

#endif
