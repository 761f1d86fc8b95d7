// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/color_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace odosplat {
namespace {

using Triple = std::array<double, 3>;

constexpr Triple white_xyz{0.95047, 1.0, 1.08883};  // D65

double lab_inverse(double f) {
  constexpr double delta = 6.0 / 29.0;
  return f > delta ? f * f * f : 3.0 * delta * delta * (f - 4.0 / 29.0);
}

double lab_forward(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

Triple lab_to_linear(double l, double a, double b) {
  const double fy = (l + 16.0) / 116.0;
  const double x = white_xyz[0] * lab_inverse(fy + a / 500.0);
  const double y = white_xyz[1] * lab_inverse(fy);
  const double z = white_xyz[2] * lab_inverse(fy - b / 200.0);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

bool in_gamut(const Triple& linear) {
  return std::ranges::all_of(linear, [](double c) { return c >= 0.0 && c <= 1.0; });
}

unsigned char encode(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255.0 * s));
}

double decode(unsigned char value) {
  const double s = value / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

Rgb lch_color(double l, double hue_deg, double chroma_limit) {
  const double hue = hue_deg * std::numbers::pi / 180.0;
  double low = 0.0;
  double high = chroma_limit;
  if (!in_gamut(lab_to_linear(l, high * std::cos(hue), high * std::sin(hue)))) {
    for (int i = 0; i < 24; ++i) {
      const double c = 0.5 * (low + high);
      (in_gamut(lab_to_linear(l, c * std::cos(hue), c * std::sin(hue))) ? low : high) = c;
    }
  } else {
    low = high;
  }
  const Triple linear = lab_to_linear(l, low * std::cos(hue), low * std::sin(hue));
  return {encode(linear[0]), encode(linear[1]), encode(linear[2])};
}

constexpr int table_size = 1024;
using Table = std::array<Rgb, table_size>;

Table make_table(ColorScale scale) {
  Table table;
  for (int i = 0; i < table_size; ++i) {
    const double t = static_cast<double>(i) / (table_size - 1);
    table[static_cast<std::size_t>(i)] = scale == ColorScale::depth
                                             ? lch_color(12.0 + 80.0 * t, 305.0 - 208.0 * t, 32.0 + 36.0 * t * t * t)
                                             : lch_color(95.0 - 80.0 * t, 98.0 - 138.0 * t, 24.0 + 110.0 * t * (1 - t));
  }
  return table;
}

}  // namespace

Rgb scale_color(ColorScale scale, double t) {
  static const Table depth_table = make_table(ColorScale::depth);
  static const Table error_table = make_table(ColorScale::error);
  const double clamped = t > 0.0 ? std::min(t, 1.0) : 0.0;  // NaN fails the comparison
  const auto i = static_cast<std::size_t>(std::lround(clamped * (table_size - 1)));
  return scale == ColorScale::depth ? depth_table[i] : error_table[i];
}

double lightness(const Rgb& color) {
  const double y = 0.2126729 * decode(color[0]) + 0.7151522 * decode(color[1]) + 0.0721750 * decode(color[2]);
  return 116.0 * lab_forward(y) - 16.0;
}

Rgb toward_white(const Rgb& color, double share) {
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    result[c] = static_cast<unsigned char>(std::lround(color[c] + (255.0 - color[c]) * std::clamp(share, 0.0, 1.0)));
  }
  return result;
}

Rgb series_color(std::size_t index) {
  static const std::array<Rgb, 7> palette{Rgb{0, 114, 178},   Rgb{213, 94, 0},   Rgb{0, 0, 0},    Rgb{0, 158, 115},
                                          Rgb{204, 121, 167}, Rgb{86, 180, 233}, Rgb{230, 159, 0}};
  return palette[index % palette.size()];
}

Rgb hatch_color(int x, int y, int pitch) {
  const int step = std::max(pitch, 2);
  return (x + y) % step < (step + 2) / 3 ? hatch_dark : hatch_light;
}

}  // namespace odosplat
