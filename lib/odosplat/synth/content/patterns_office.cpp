// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cmath>

#include "odosplat/synth/content/noise.hpp"
#include "odosplat/synth/content/pattern_parts.hpp"
#include "odosplat/synth/content/patterns.hpp"

namespace odosplat {
namespace {

using Color = Eigen::Vector3f;

/// Whether (x, y) is on a letter of a page set in lines of the given height: words of random length, ragged right.
bool on_letter(float x, float y, float line_height, std::uint32_t seed) {
  const int line = static_cast<int>(std::floor(y / line_height));
  const float v = fraction(y / line_height);
  if (v < 0.35F || v > 0.8F || hash01(line, 1, seed) < 0.15F) return false;
  if (x > 0.55F + 0.4F * hash01(line, 2, seed)) return false;
  const float pitch = 0.45F * line_height;
  const int letter = static_cast<int>(std::floor(x / pitch));
  if (hash01(letter / 2 + 31 * line, 3, seed) < 0.16F) return false;
  return fraction(x / pitch) < 0.35F + 0.5F * hash01(letter, line, seed + 1);
}

}  // namespace

ColorImage carpet_tile_pattern(int size, int tiles, const Color& color, float contrast, std::uint32_t seed) {
  const auto n = static_cast<float>(tiles);
  return paint(size, size, [=](float x, float y) -> Color {
    const int column = static_cast<int>(x * n);
    const int row = static_cast<int>(y * n);
    const bool turned = (column + row) % 2 == 1;
    const float u = turned ? y : x;
    const float v = turned ? x : y;
    const float pile = fractal_noise(16.0F * u, 96.0F * v, 96, 3, 0.7F, seed + (turned ? 9U : 0U));
    const float worn = fractal_noise(3.0F * x, 3.0F * y, 3, 3, 0.5F, seed + 3);
    const float tone = hash01(column, row, seed + 5) - 0.5F;
    return color * (1.0F + contrast * (1.3F * pile + 0.7F * worn + 0.35F * tone));
  });
}

ColorImage ceiling_tile_pattern(int size, int tiles, const Color& color, const Color& rail, std::uint32_t seed) {
  const auto n = static_cast<float>(tiles);
  return paint(size, size, [=](float x, float y) -> Color {
    const float u = fraction(x * n);
    const float v = fraction(y * n);
    const float edge = std::min(std::min(u, 1.0F - u), std::min(v, 1.0F - v));
    if (edge < 0.018F) return rail;
    const float holes = fractal_noise(40.0F * x * n, 40.0F * y * n, 40 * tiles, 2, 0.6F, seed);
    const float shade = edge < 0.03F ? 0.9F : 1.0F;
    return color * (shade - 0.05F * std::max(0.0F, holes));
  });
}

ColorImage keyboard_pattern(int width, int height, const Color& body, const Color& keys) {
  return paint(width, height, [=](float x, float y) -> Color {
    const bool block = x > 0.76F;  // digits apart from the letters
    const float u = block ? (x - 0.78F) / 0.2F * 4.0F : (x - 0.02F) / 0.72F * 15.0F;
    const float v = (y - 0.06F) / 0.88F * 6.0F;
    if (u < 0.0F || v < 0.0F || v >= 6.0F || u >= (block ? 4.0F : 15.0F)) return body;
    if (v >= 5.0F && !block && u > 4.0F && u < 10.0F) return fraction(v) > 0.12F && fraction(v) < 0.88F ? keys : body;
    const float a = fraction(u + (block ? 0.0F : 0.3F * std::floor(v)));
    const float b = fraction(v);
    if (a < 0.1F || a > 0.9F || b < 0.12F || b > 0.88F) return body;
    return a > 0.3F && a < 0.5F && b > 0.25F && b < 0.5F ? mix(keys, body, 0.8F) : keys;
  });
}

ColorImage screen_pattern(int width, int height, std::uint32_t seed) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return paint(width, height, [=](float x, float y) -> Color {
    // A desktop with a wallpaper, a task bar and two windows, one of them a page, the other a terminal.
    const float glow = fractal_noise(3.0F * x, 2.0F * y, 64, 4, 0.5F, seed);
    Color color = mix({0.16F, 0.30F, 0.46F}, {0.55F, 0.66F, 0.72F}, std::clamp(0.5F + glow, 0.0F, 1.0F));
    if (y > 0.95F)
      return fraction(x * 24.0F) < 0.5F && x < 0.3F ? Color(0.6F, 0.62F, 0.65F) : Color(0.15F, 0.16F, 0.2F);
    struct Window {
      float left, top, right, bottom;
      bool dark;
    };
    const float shift = 0.1F * hash01(1, 2, seed);
    const Window windows[2] = {{0.42F - shift, 0.2F, 0.96F, 0.86F, true}, {0.05F, 0.08F, 0.55F + shift, 0.9F, false}};
    for (const Window& w : windows) {
      if (x < w.left || x > w.right || y < w.top || y > w.bottom) continue;
      if (y < w.top + 0.04F) {
        color = {0.45F, 0.5F, 0.56F};
        continue;
      }
      color = w.dark ? Color(0.10F, 0.12F, 0.14F) : Color(0.90F, 0.90F, 0.88F);
      const float u = (x - w.left - 0.01F) / (w.right - w.left);
      const float v = (y - w.top - 0.05F) * 1.2F;
      if (u < 0.0F || v < 0.0F) continue;
      if (on_letter(u, v, 0.045F, seed + (w.dark ? 3U : 7U))) {
        const float hue = hash01(static_cast<int>(v / 0.045F), 9, seed);
        color = w.dark ? mix({0.35F, 0.7F, 0.4F}, {0.75F, 0.75F, 0.7F}, hue)
                       : mix({0.1F, 0.1F, 0.1F}, {0.2F, 0.3F, 0.6F}, hue);
      }
    }
    return color * (1.0F - 0.1F * std::abs(x - 0.5F) / aspect);
  });
}

ColorImage document_pattern(int width, int height, std::uint32_t seed) {
  return paint(width, height, [=](float x, float y) -> Color {
    Color paper(0.92F, 0.91F, 0.87F);
    if (x < 0.1F || x > 0.9F || y < 0.08F || y > 0.92F) return paper;
    const float u = (x - 0.1F) / 0.8F;
    const float v = (y - 0.08F) / 0.84F;
    // A heading, a figure in the middle of the page, and text.
    if (v < 0.07F) return u < 0.6F && on_letter(0.5F * u, v + 0.01F, 0.07F, seed) ? Color(0.15F, 0.15F, 0.18F) : paper;
    if (v > 0.36F && v < 0.6F && hash01(0, 0, seed) > 0.4F) {
      const float curve = 0.5F + 0.8F * fractal_noise(4.0F * u, 0.5F, 64, 4, 0.5F, seed + 2);
      const float h = (v - 0.36F) / 0.24F;
      if (u < 0.02F || h > 0.96F) return {0.2F, 0.2F, 0.2F};
      return 1.0F - h < curve ? Color(0.48F, 0.58F, 0.70F) : paper;
    }
    return on_letter(u, v, 0.028F, seed + 1) ? Color(0.25F, 0.25F, 0.27F) : paper;
  });
}

ColorImage whiteboard_pattern(int width, int height, std::uint32_t seed) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return paint(width, height, [=](float x, float y) -> Color {
    const float wiped = fractal_noise(3.0F * aspect * x, 5.0F * y, 64, 4, 0.6F, seed);
    Color color = Color(0.93F, 0.94F, 0.94F) * (1.0F + 0.04F * wiped);
    const Color inks[3] = {{0.16F, 0.2F, 0.5F}, {0.55F, 0.14F, 0.14F}, {0.12F, 0.13F, 0.14F}};
    const float u = aspect * x + 0.008F * fractal_noise(9.0F * aspect * x, 9.0F * y, 256, 3, 0.5F, seed + 1);
    const float v = y + 0.008F * fractal_noise(9.0F * aspect * x, 9.0F * y, 256, 3, 0.5F, seed + 2);
    // Boxes joined by lines, on the left and in the middle; handwriting on the right.
    for (int i = 0; i < 5; ++i) {
      const float cx = 0.25F + 0.28F * static_cast<float>(i % 3) + 0.05F * hash01(i, 1, seed);
      const float cy = (i < 3 ? 0.3F : 0.68F) + 0.06F * hash01(i, 2, seed);
      const float a = std::abs(u - cx) - 0.09F;
      const float b = std::abs(v - cy) - 0.07F;
      const float outline = std::abs(std::max(a, b));
      if (outline < 0.006F) color = inks[0];
      if (i < 2 && std::abs(v - cy) < 0.005F && u > cx + 0.09F && u < cx + 0.19F) color = inks[1];
      if (a < -0.02F && b < -0.02F && on_letter((u - cx + 0.09F) * 3.0F, v - cy + 0.2F, 0.05F, seed + 11U))
        color = inks[2];
    }
    const float left = 0.62F * aspect;
    if (u > left && u < 0.95F * aspect && v > 0.15F && v < 0.8F) {
      if (on_letter((u - left) / (0.33F * aspect), v, 0.085F, seed + 5)) color = inks[2];
    }
    return color;
  });
}

}  // namespace odosplat
