// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/splat/reference/image_loss.hpp"

#include <cmath>

namespace odosplat::reference {

namespace {

constexpr int radius = 5;
constexpr double sigma = 1.5;

/// Window of one pixel: indices into the plane and weights that sum to one.
struct Window {
  std::vector<std::size_t> index;
  std::vector<double> weight;
};

Window window_at(int x, int y, int width, int height) {
  Window window;
  double sum = 0.0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const int u = x + dx;
      const int v = y + dy;
      if (u < 0 || u >= width || v < 0 || v >= height) continue;
      const double w = std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma));
      window.index.push_back(static_cast<std::size_t>(v * width + u));
      window.weight.push_back(w);
      sum += w;
    }
  }
  for (double& w : window.weight) w /= sum;
  return window;
}

/// SSIM of one window; adds `factor` times its gradient by every rendered pixel in it to `gradient`.
double add_window(const Window& window, const double* x, const double* y, double factor, double* gradient) {
  double mx = 0.0;
  double my = 0.0;
  for (std::size_t k = 0; k < window.index.size(); ++k) {
    mx += window.weight[k] * x[window.index[k]];
    my += window.weight[k] * y[window.index[k]];
  }
  double vx = 0.0;
  double vy = 0.0;
  double cov = 0.0;
  for (std::size_t k = 0; k < window.index.size(); ++k) {
    const double a = x[window.index[k]] - mx;
    const double b = y[window.index[k]] - my;
    vx += window.weight[k] * a * a;
    vy += window.weight[k] * b * b;
    cov += window.weight[k] * a * b;
  }
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const double luminance = (2.0 * mx * my + c1) / (mx * mx + my * my + c1);
  const double structure = (2.0 * cov + c2) / (vx + vy + c2);
  for (std::size_t k = 0; k < window.index.size(); ++k) {
    const double w = window.weight[k];
    const double d_luminance = w * (2.0 * my - luminance * 2.0 * mx) / (mx * mx + my * my + c1);
    const double d_cov = w * (y[window.index[k]] - my);
    const double d_vx = 2.0 * w * (x[window.index[k]] - mx);
    const double d_structure = (2.0 * d_cov - structure * d_vx) / (vx + vy + c2);
    gradient[window.index[k]] += factor * (d_luminance * structure + luminance * d_structure);
  }
  return luminance * structure;
}

}  // namespace

ImageLossResult image_loss(const std::vector<double>& rendered, const std::vector<double>& target, int width,
                           int height, double ssim_weight, bool squared) {
  ImageLossResult result;
  const double n = 3.0 * width * height;
  const auto plane = static_cast<std::size_t>(width * height);
  result.gradient.assign(rendered.size(), 0.0);
  for (std::size_t i = 0; i < rendered.size(); ++i) {
    const double d = rendered[i] - target[i];
    result.l1 += std::abs(d) / n;
    result.mse += d * d / n;
    const double sign = d > 0.0 ? 1.0 : (d < 0.0 ? -1.0 : 0.0);
    result.gradient[i] = (1.0 - ssim_weight) / n * (squared ? 2.0 * d : sign);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Window window = window_at(x, y, width, height);
      for (std::size_t c = 0; c < 3; ++c)
        result.ssim += add_window(window, rendered.data() + c * plane, target.data() + c * plane, -ssim_weight / n,
                                  result.gradient.data() + c * plane) /
                       n;
    }
  }
  result.loss = (1.0 - ssim_weight) * (squared ? result.mse : result.l1) + ssim_weight * (1.0 - result.ssim);
  return result;
}

}  // namespace odosplat::reference
