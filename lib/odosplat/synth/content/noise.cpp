// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/noise.hpp"

#include <array>
#include <cmath>
#include <initializer_list>

#include "odosplat/core/angles.hpp"

namespace odosplat {
namespace {

float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

int wrap(int i, int period) {
  const int r = i % period;
  return r < 0 ? r + period : r;
}

/// 256 unit vectors around the circle.
const std::array<std::array<float, 2>, 256>& gradients() {
  static const auto table = [] {
    std::array<std::array<float, 2>, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const float angle = static_cast<float>(i) * (2.0F * float_pi / 256.0F);
      t[i] = {std::cos(angle), std::sin(angle)};
    }
    return t;
  }();
  return table;
}

/// Gradient at a lattice point times the offset from it.
float corner(int x, int y, float dx, float dy, std::uint32_t seed) {
  const auto& g = gradients()[lattice_hash(x, y, seed) >> 24];
  return g[0] * dx + g[1] * dy;
}

}  // namespace

std::uint32_t lattice_hash(int x, int y, std::uint32_t seed) {
  // Multiply-xorshift rounds over the three words.
  std::uint32_t h = seed * 0x9E3779B1U ^ 0x85EBCA6BU;
  for (const std::uint32_t word : {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}) {
    h ^= word;
    h *= 0xCC9E2D51U;
    h ^= h >> 15;
    h *= 0x1B873593U;
    h ^= h >> 13;
  }
  h *= 0xC2B2AE35U;
  return h ^ (h >> 16);
}

float hash01(int x, int y, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, seed) >> 8) / 16777216.0F;
}

float gradient_noise(float x, float y, int period, std::uint32_t seed) {
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  const int x0 = wrap(static_cast<int>(fx), period);
  const int y0 = wrap(static_cast<int>(fy), period);
  const int x1 = wrap(x0 + 1, period);
  const int y1 = wrap(y0 + 1, period);
  const float u = x - fx;
  const float v = y - fy;
  const float a = fade(u);
  const float b = fade(v);
  const float top = (1.0F - a) * corner(x0, y0, u, v, seed) + a * corner(x1, y0, u - 1.0F, v, seed);
  const float bottom = (1.0F - a) * corner(x0, y1, u, v - 1.0F, seed) + a * corner(x1, y1, u - 1.0F, v - 1.0F, seed);
  return (1.0F - b) * top + b * bottom;
}

float fractal_noise(float x, float y, int period, int octaves, float gain, std::uint32_t seed) {
  float sum = 0.0F;
  float total = 0.0F;
  float amplitude = 1.0F;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * gradient_noise(x, y, period, seed + static_cast<std::uint32_t>(i) * 101U);
    total += amplitude;
    amplitude *= gain;
    x *= 2.0F;
    y *= 2.0F;
    period *= 2;
  }
  return sum / total;
}

}  // namespace odosplat
