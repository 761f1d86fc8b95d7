// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/disturb/disturb_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "odosplat/core/random.hpp"

namespace odosplat::accuracy {
namespace {

float clipped(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

/// An image of value(y, x), clipped to 0..1.
template <typename Value>
GrayImage made(int rows, int cols, Value&& value) {
  GrayImage out(rows, cols);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x) out(y, x) = clipped(value(y, x));
  }
  return out;
}

}  // namespace

GrayImage with_noise(const GrayImage& image, double sigma, std::uint64_t seed) {
  Random random(seed);
  return made(image.rows, image.cols, [&](int y, int x) { return image(y, x) + sigma * random.normal(); });
}

GrayImage with_gamma(const GrayImage& image, double gamma) {
  return made(image.rows, image.cols, [&](int y, int x) { return std::pow(static_cast<double>(image(y, x)), gamma); });
}

GrayImage with_gain(const GrayImage& image, double gain) {
  return made(image.rows, image.cols, [&](int y, int x) { return gain * image(y, x); });
}

double exposure_gain(double time, double step, double period) {
  switch (static_cast<long>(std::floor(time / period)) % 4) {
    case 1:
      return step;
    case 3:
      return 1.0 / step;
    default:
      return 1.0;
  }
}

GrayImage with_motion_blur(const GrayImage& image, const Eigen::Vector2d& direction, double length) {
  const double norm = direction.norm();
  const Eigen::Vector2d along = norm > 0.0 ? Eigen::Vector2d(direction / norm) : Eigen::Vector2d(1.0, 0.0);
  const int half = std::max(1, static_cast<int>(std::ceil(length)));
  const auto max_u = static_cast<float>(image.cols - 1);
  const auto max_v = static_cast<float>(image.rows - 1);
  return made(image.rows, image.cols, [&](int y, int x) {
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) {
      const Eigen::Vector2d at = Eigen::Vector2d(x, y) + (0.5 * length * k / half) * along;
      sum += bilinear(image, std::clamp(static_cast<float>(at.x()), 0.0F, max_u),
                      std::clamp(static_cast<float>(at.y()), 0.0F, max_v));
    }
    return sum / (2 * half + 1);
  });
}

Eigen::Vector2d center_motion(const Camera& camera, const SE3& T_world_from, const SE3& T_world_to, double depth) {
  const Eigen::Vector2d center((camera.width - 1) / 2.0, (camera.height - 1) / 2.0);
  const Eigen::Vector3d p_from = depth * camera.ray(center.x(), center.y());
  const Eigen::Vector3d p_to = T_world_to.inverse() * (T_world_from * p_from);
  if (!(p_to.z() > 0.0)) return Eigen::Vector2d::Zero();
  return camera.project(p_to) - center;
}

GrayImage with_rolling_gain(const GrayImage& image, double amplitude, double phase) {
  return made(image.rows, image.cols, [&](int y, int x) {
    const double turn = static_cast<double>(y) / image.rows + phase;
    return image(y, x) * (1.0 + amplitude * std::sin(2.0 * std::numbers::pi * turn));
  });
}

GrayImage mirrored(const GrayImage& image, int code) {
  GrayImage out;
  cv::flip(image, out, code);
  return out;
}

GrayImage with_right_half(const GrayImage& image, const GrayImage& other) {
  GrayImage half = image.clone();
  other.colRange(image.cols / 2, image.cols).copyTo(half.colRange(image.cols / 2, image.cols));
  return half;
}

GrayImage uniform_image(const Camera& camera, double value) {
  return GrayImage(camera.height, camera.width, static_cast<float>(value));
}

}  // namespace odosplat::accuracy
