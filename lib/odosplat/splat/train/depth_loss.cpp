// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/depth_loss.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {

void DepthLossOptions::check() const {
  require(weight >= 0.0 && std::isfinite(weight), "depth_weight", "at least 0");
  require(cut > 1e-3 && std::isfinite(cut), "depth_cut", "above 0.001");
}

DepthLoss::DepthLoss(const compute::Context& context, const DepthLossOptions& options)
    : options_((options.check(), options)),
      context_(context),
      kernel_(compute::Program(context, {"depth_loss.cl"}).kernel("depth_loss", "loss")) {}

void DepthLoss::evaluate(const compute::Buffer<float>& rendered, const compute::Buffer<float>& target,
                         const compute::Buffer<float>& pixel_weight, int width, int height,
                         compute::Buffer<float>& gradient) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  gradient.resize(context_, pixels);
  rows_.resize(context_, 2 * static_cast<std::size_t>(height));
  kernel_(compute::Range::linear(static_cast<std::size_t>(height), 8), rendered, target, pixel_weight, gradient, rows_,
          std::int32_t{width}, std::int32_t{height}, static_cast<float>(options_.weight / static_cast<double>(pixels)),
          static_cast<float>(options_.cut));
}

double DepthLoss::mean_relative_error() const {
  if (rows_.empty()) return 0.0;
  const std::vector<float> rows = rows_.download();
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t y = 0; y < rows.size() / 2; ++y) {
    sum += static_cast<double>(rows[y]);
    weights += static_cast<double>(rows[rows.size() / 2 + y]);
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace odosplat
