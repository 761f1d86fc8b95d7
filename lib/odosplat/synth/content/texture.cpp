// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/texture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr float gamma = 2.2F;

/// Linear light of each 8-bit stored value.
const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = std::pow(static_cast<float>(i) / 255.0F, gamma);
    return t;
  }();
  return table;
}

}  // namespace

float to_linear(float stored) { return std::pow(std::max(stored, 0.0F), gamma); }
float from_linear(float linear) { return std::pow(std::max(linear, 0.0F), 1.0F / gamma); }

Texture::Texture(const ColorImage& image, const Eigen::Vector2f& size_m, Edge edge) : size_m_(size_m), edge_(edge) {
  require(!image.empty(), "texture image", "not empty");
  require(size_m.minCoeff() > 0.0F, "texture size", "positive");
  // Levels are averaged in linear light, as a camera averages light; a side of 1 stays 1.
  ColorImage linear(image.rows, image.cols);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (int c = 0; c < 3; ++c) linear(y, x)[c] = to_linear(image(y, x)[c]);
    }
  }
  for (;;) {
    Level level{linear.cols, linear.rows, {}};
    level.texels.reserve(linear.total());
    for (const cv::Vec3f& p : linear) {
      std::array<std::uint8_t, 4> t{0, 0, 0, 255};
      for (int c = 0; c < 3; ++c) {
        const float stored = 255.0F * from_linear(p[c]) + 0.5F;
        t[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::clamp(stored, 0.0F, 255.0F));
      }
      level.texels.push_back(t);
    }
    levels_.push_back(std::move(level));
    if (linear.rows == 1 && linear.cols == 1) break;
    ColorImage half;
    cv::resize(linear, half, {std::max(1, linear.cols / 2), std::max(1, linear.rows / 2)}, 0, 0, cv::INTER_AREA);
    linear = half;
  }
}

Eigen::Vector2f Texture::texels() const {
  return {static_cast<float>(levels_[0].width), static_cast<float>(levels_[0].height)};
}

Eigen::Vector3f Texture::sample(const Eigen::Vector2f& uv, float footprint) const {
  const int last = static_cast<int>(levels_.size()) - 1;
  const float wanted = footprint > 1.0F ? std::log2(footprint) : 0.0F;
  if (wanted >= static_cast<float>(last)) return bilinear(levels_.back(), uv);
  const int fine = static_cast<int>(wanted);
  const float s = wanted - static_cast<float>(fine);
  Eigen::Vector3f a = bilinear(levels_[static_cast<std::size_t>(fine)], uv);
  if (s < 0.02F) return a;
  const Eigen::Vector3f b = bilinear(levels_[static_cast<std::size_t>(fine) + 1], uv);
  return (1.0F - s) * a + s * b;
}

Eigen::Vector3f Texture::bilinear(const Level& level, const Eigen::Vector2f& uv) const {
  float u = uv.x();
  float v = uv.y();
  if (edge_ == Edge::repeat) {
    u -= std::floor(u);
    v -= std::floor(v);
  } else {
    u = std::clamp(u, 0.0F, 1.0F);
    v = std::clamp(v, 0.0F, 1.0F);
  }
  // Texel centres lie at (i + 0.5) / size.
  const float x = u * static_cast<float>(level.width) - 0.5F;
  const float y = v * static_cast<float>(level.height) - 0.5F;
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  int x0 = static_cast<int>(fx);
  int y0 = static_cast<int>(fy);
  int x1 = x0 + 1;
  int y1 = y0 + 1;
  if (edge_ == Edge::repeat) {
    if (x0 < 0) x0 += level.width;
    if (y0 < 0) y0 += level.height;
    if (x1 >= level.width) x1 -= level.width;
    if (y1 >= level.height) y1 -= level.height;
  } else {
    x0 = std::max(x0, 0);
    y0 = std::max(y0, 0);
    x1 = std::min(x1, level.width - 1);
    y1 = std::min(y1, level.height - 1);
  }
  const float a = x - fx;
  const float b = y - fy;
  const std::array<float, 256>& linear = linear_of_byte();
  auto texel = [&](int tx, int ty) -> const std::array<std::uint8_t, 4>& {
    return level
        .texels[static_cast<std::size_t>(ty) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(tx)];
  };
  const auto& t00 = texel(x0, y0);
  const auto& t10 = texel(x1, y0);
  const auto& t01 = texel(x0, y1);
  const auto& t11 = texel(x1, y1);
  Eigen::Vector3f color;
  for (std::size_t c = 0; c < 3; ++c) {
    color[static_cast<int>(c)] = (1.0F - b) * ((1.0F - a) * linear[t00[c]] + a * linear[t10[c]]) +
                                 b * ((1.0F - a) * linear[t01[c]] + a * linear[t11[c]]);
  }
  return color;
}

}  // namespace odosplat
