// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"
#include "odosplat/synth/content/noise.hpp"
#include "odosplat/synth/content/pattern_parts.hpp"
#include "odosplat/synth/content/patterns.hpp"

namespace odosplat {
namespace {

using Color = Eigen::Vector3f;

/// 0 below `low`, 1 above `high`, smooth between.
float step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// Wood's tone 0..1 at (x, y) of a tile; grain along x.
float grain(float x, float y, std::uint32_t seed) {
  const float bend = 0.6F * gradient_noise(3.0F * x, 3.0F * y, 3, seed);
  const float rings = 0.5F + 0.5F * std::sin(2.0F * float_pi * (4.0F * y + 2.5F * bend));
  const float fibres = fractal_noise(8.0F * x, 64.0F * y, 8, 2, 0.5F, seed + 7);
  const float patches = fractal_noise(2.0F * x, 4.0F * y, 2, 3, 0.5F, seed + 9);
  return std::clamp(0.4F + 0.2F * rings + 0.5F * fibres + 0.6F * patches, 0.0F, 1.0F);
}

}  // namespace

ColorImage wood_pattern(int width, int height, const Color& dark, const Color& bright, std::uint32_t seed) {
  return paint(width, height, [=](float x, float y) { return mix(dark, bright, grain(x, y, seed)); });
}

ColorImage plank_pattern(int size, int planks, const Color& dark, const Color& bright, std::uint32_t seed) {
  const auto n = static_cast<float>(planks);
  return paint(size, size, [=](float x, float y) -> Color {
    const int row = static_cast<int>(y * n);
    const float across = fraction(y * n);
    // Two boards per row and tile, shifted from row to row.
    const float along = x + hash01(row, 0, seed);
    const int board = static_cast<int>(std::floor(2.0F * along)) & 1;
    const float in_board = fraction(2.0F * along);
    const float tone = hash01(row, 1 + board, seed + 1);
    const std::uint32_t own = seed + 31U * static_cast<std::uint32_t>(2 * row + board);
    const float wood = grain(x, fraction(0.25F * across + hash01(row, board, seed + 2)), own);
    const float edge = std::min(std::min(across, 1.0F - across) / n, 0.5F * std::min(in_board, 1.0F - in_board));
    const float joint = step(0.0004F, 0.0016F, edge);
    return mix(dark, bright, 0.25F + 0.45F * tone + 0.45F * (wood - 0.5F)) * (0.62F + 0.38F * joint);
  });
}

ColorImage plaster_pattern(int size, const Color& color, float contrast, std::uint32_t seed) {
  return paint(size, size, [=](float x, float y) -> Color {
    const float coarse = fractal_noise(4.0F * x, 4.0F * y, 4, 3, 0.5F, seed);
    const float fine = fractal_noise(64.0F * x, 64.0F * y, 64, 2, 0.7F, seed + 5);
    return color * (1.0F + contrast * (1.2F * coarse + 1.2F * fine));
  });
}

ColorImage brick_pattern(int width, int height, int columns, int rows, std::uint32_t seed) {
  return paint(width, height, [=](float x, float y) -> Color {
    const int row = static_cast<int>(y * static_cast<float>(rows));
    const float along = x * static_cast<float>(columns) + (row % 2 == 0 ? 0.0F : 0.5F);
    const int column = static_cast<int>(std::floor(along)) % columns;
    const float u = fraction(along);
    const float v = fraction(y * static_cast<float>(rows));
    const float rough = fractal_noise(24.0F * x, 24.0F * y, 24, 4, 0.6F, seed);
    // A brick is three times as long as high; mortar is a twelfth of its height.
    const float edge = std::min(3.0F * std::min(u, 1.0F - u), std::min(v, 1.0F - v)) + 0.05F * rough;
    const float tone = hash01(column, row, seed + 1);
    const Color brick = mix({0.66F, 0.52F, 0.45F}, {0.74F, 0.60F, 0.53F}, tone) * (1.0F + 0.25F * rough);
    const Color mortar = Color(0.74F, 0.69F, 0.64F) * (1.0F + 0.2F * rough);
    return mix(mortar, brick, step(0.06F, 0.12F, edge));
  });
}

ColorImage cloth_pattern(int size, const Color& color, const Color& stripe, int stripes, std::uint32_t seed) {
  return paint(size, size, [=](float x, float y) -> Color {
    const float warp = std::sin(2.0F * float_pi * 60.0F * x);
    const float weft = std::sin(2.0F * float_pi * 60.0F * y);
    const float uneven = fractal_noise(6.0F * x, 6.0F * y, 6, 5, 0.6F, seed);
    const float shade = 1.0F + 0.05F * warp * weft + 0.22F * uneven;
    float share = 0.0F;
    if (stripes > 0) share = step(0.60F, 0.64F, fraction(x * static_cast<float>(stripes)));
    return mix(color, stripe, share) * shade;
  });
}

ColorImage carpet_pattern(int width, int height, std::uint32_t seed) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return paint(width, height, [=](float x, float y) -> Color {
    const Color red(0.48F, 0.13F, 0.13F);
    const Color blue(0.14F, 0.18F, 0.34F);
    const Color cream(0.80F, 0.71F, 0.55F);
    const Color gold(0.66F, 0.48F, 0.24F);
    const float u = aspect * x;  // both coordinates in heights
    const float edge = std::min(std::min(u, aspect - u), std::min(y, 1.0F - y));
    const float pile = fractal_noise(40.0F * u, 40.0F * y, 1024, 3, 0.7F, seed);
    Color color = red;
    if (edge < 0.02F) {
      color = cream;
    } else if (edge < 0.15F) {
      // Border: a row of diamonds along the side that is nearest.
      const bool side = std::min(u, aspect - u) < std::min(y, 1.0F - y);
      const float along = fraction((side ? y : u) / 0.12F) - 0.5F;
      const float across = (edge - 0.085F) / 0.12F;
      const float diamond = std::abs(along) + std::abs(across);
      color = diamond < 0.18F ? red : diamond < 0.34F ? gold : blue;
      if (edge < 0.032F || edge > 0.138F) color = gold;
    } else {
      const float du = (u - 0.5F * aspect) / 0.40F;
      const float dv = (y - 0.5F) / 0.27F;
      const float angle = std::atan2(dv, du);
      const float petal = std::sqrt(du * du + dv * dv) * (1.0F + 0.12F * std::cos(12.0F * angle));
      if (petal < 1.0F) {
        color = petal < 0.25F ? gold : petal < 0.5F ? cream : petal < 0.58F ? red : petal < 0.92F ? blue : cream;
        if (petal > 0.64F && petal < 0.86F && std::cos(12.0F * angle) > 0.35F) color = gold;
      } else {
        // Small flowers on a staggered grid.
        const float gv = y / 0.11F;
        const int row = static_cast<int>(gv);
        const float gu = u / 0.11F + (row % 2 == 0 ? 0.0F : 0.5F);
        const float fu = fraction(gu) - 0.5F;
        const float fv = fraction(gv) - 0.5F;
        const float flower = std::sqrt(fu * fu + fv * fv) * (1.0F + 0.3F * std::cos(5.0F * std::atan2(fv, fu)));
        const bool odd = hash01(static_cast<int>(gu), row, seed + 3) > 0.5F;
        if (flower < 0.10F)
          color = gold;
        else if (flower < 0.22F)
          color = odd ? cream : blue;
      }
    }
    return mix(color, {0.5F, 0.35F, 0.3F}, 0.5F) * (0.96F + 0.3F * pile);
  });
}

namespace {

Color landscape(float x, float y, std::uint32_t seed) {
  const Color sky = mix({0.45F, 0.60F, 0.80F}, {0.95F, 0.80F, 0.62F}, step(0.0F, 0.55F, y));
  const float cloud = step(0.05F, 0.35F, fractal_noise(4.0F * x, 9.0F * y, 64, 5, 0.55F, seed));
  Color color = mix(sky, {0.95F, 0.93F, 0.90F}, 0.7F * cloud);
  const Color ridges[4] = {{0.52F, 0.58F, 0.68F}, {0.36F, 0.45F, 0.48F}, {0.27F, 0.38F, 0.25F}, {0.20F, 0.24F, 0.13F}};
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<float>(i);
    const std::uint32_t own = seed + 11U * static_cast<std::uint32_t>(i + 1);
    const float height =
        0.42F + 0.13F * k + (0.22F - 0.03F * k) * fractal_noise((2.0F + k) * x, 0.5F, 64, 5, 0.5F, own);
    if (y < height) continue;
    const float rough = fractal_noise((10.0F + 6.0F * k) * x, (16.0F + 6.0F * k) * y, 256, 4, 0.65F, own + 3);
    color = ridges[i] * (1.0F + 0.9F * rough);
  }
  return color;
}

Color town(float x, float y, std::uint32_t seed) {
  Color color = mix({0.30F, 0.42F, 0.62F}, {0.90F, 0.72F, 0.55F}, step(0.1F, 0.8F, y));
  for (int layer = 0; layer < 3; ++layer) {
    const float columns = 6.0F + 3.0F * static_cast<float>(layer);
    const std::uint32_t own = seed + 17U * static_cast<std::uint32_t>(layer);
    const float along = x * columns + hash01(layer, 5, seed);
    const int house = static_cast<int>(along);
    const float top = 0.30F + 0.17F * static_cast<float>(layer) + 0.22F * hash01(house, 1, own);
    const float u = fraction(along);
    const float roof = top - 0.05F * (1.0F - 2.0F * std::abs(u - 0.5F));
    if (y < roof) continue;
    const float r = hash01(house, 2, own);
    color = mix({0.62F, 0.36F, 0.26F}, {0.84F, 0.76F, 0.58F}, r) * (0.7F + 0.15F * static_cast<float>(layer));
    if (y < top) color = Color(0.42F, 0.20F, 0.15F);
    const float wu = fraction(3.0F * u);
    const float wv = fraction((y - top) * 14.0F);
    const bool window = wu > 0.3F && wu < 0.7F && wv > 0.25F && wv < 0.75F && y > top + 0.02F;
    if (window)
      color = hash01(static_cast<int>(3.0F * along), static_cast<int>(y * 14.0F), own + 4) > 0.6F
                  ? Color(0.95F, 0.85F, 0.5F)
                  : Color(0.18F, 0.22F, 0.28F);
  }
  return color * (1.0F + 0.25F * fractal_noise(30.0F * x, 30.0F * y, 256, 3, 0.6F, seed + 9));
}

Color abstract(float x, float y, std::uint32_t seed) {
  const float bend_x = x + 0.25F * fractal_noise(3.0F * x, 3.0F * y, 64, 4, 0.5F, seed);
  const float bend_y = y + 0.25F * fractal_noise(3.0F * x, 3.0F * y, 64, 4, 0.5F, seed + 1);
  const int a = static_cast<int>(std::floor(5.0F * bend_x));
  const int b = static_cast<int>(std::floor(4.0F * bend_y));
  const Color palette[5] = {{0.85F, 0.78F, 0.62F},
                            {0.72F, 0.30F, 0.20F},
                            {0.18F, 0.30F, 0.42F},
                            {0.90F, 0.66F, 0.25F},
                            {0.25F, 0.22F, 0.22F}};
  const Color base = palette[lattice_hash(a, b, seed + 2) % 5U];
  const float strokes = fractal_noise(40.0F * bend_x, 10.0F * bend_y, 256, 3, 0.6F, seed + 3);
  return base * (1.0F + 0.5F * strokes);
}

}  // namespace

ColorImage picture_pattern(int width, int height, int kind, std::uint32_t seed) {
  const int k = ((kind % 3) + 3) % 3;
  return paint(width, height, [=](float x, float y) {
    return k == 0 ? landscape(x, y, seed) : k == 1 ? town(x, y, seed) : abstract(x, y, seed);
  });
}

ColorImage book_pattern(int width, int height, std::uint32_t seed) {
  return paint(width, height, [=](float x, float y) -> Color {
    const float worn = fractal_noise(6.0F * x, 20.0F * y, 64, 4, 0.6F, seed);
    float tone = 0.72F + 0.25F * worn;
    // Bands across the back, and a title that runs down it.
    for (int i = 0; i < 4; ++i) {
      const float place = 0.06F + 0.88F * hash01(i, 0, seed);
      if (std::abs(y - place) < 0.006F + 0.014F * hash01(i, 1, seed)) tone = hash01(i, 2, seed) > 0.5F ? 0.95F : 0.5F;
    }
    const float from = 0.2F + 0.2F * hash01(9, 0, seed);
    const float to = 0.55F + 0.3F * hash01(9, 1, seed);
    if (y > from && y < to && x > 0.32F && x < 0.68F) {
      const int letter = static_cast<int>(y * 42.0F);
      const int stroke = static_cast<int>(x * 14.0F);
      if (hash01(letter, stroke, seed + 1) > 0.45F && fraction(y * 42.0F) > 0.25F) {
        tone = hash01(9, 2, seed) > 0.4F ? 0.95F : 0.45F;
      }
    }
    const float round = 1.0F - 0.35F * std::pow(std::abs(2.0F * x - 1.0F), 3.0F);
    return Color::Constant(tone * round);
  });
}

ColorImage outdoor_pattern(int width, int height, std::uint32_t seed) {
  return paint(width, height, [=](float x, float y) -> Color {
    const float cloud = fractal_noise(12.0F * x, 10.0F * y, 12, 5, 0.55F, seed);
    const Color sky = mix({0.66F, 0.78F, 0.95F}, {0.93F, 0.95F, 0.98F}, step(0.1F, 0.5F, y));
    Color color = mix(sky, {1.0F, 1.0F, 1.0F}, step(-0.05F, 0.3F, cloud));
    const float crown = fractal_noise(32.0F * x, 0.5F, 32, 5, 0.6F, seed + 3);
    if (y > 0.47F - 0.05F * crown) {
      const float leaves = fractal_noise(96.0F * x, 48.0F * y, 96, 4, 0.7F, seed + 5);
      color = Color(0.46F, 0.55F, 0.36F) * (1.0F + 0.5F * leaves);
    }
    if (y > 0.53F)
      color = Color(0.46F, 0.52F, 0.33F) * (1.0F + 0.3F * fractal_noise(64.0F * x, 64.0F * y, 64, 4, 0.6F, seed + 6));
    return color;
  });
}

}  // namespace odosplat
