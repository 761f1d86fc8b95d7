// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/residual_weights.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

std::size_t block_at(const ResidualWeights& grid, double u, double v) {
  const int column = std::clamp(static_cast<int>((u + 0.5) / grid.block), 0, grid.columns - 1);
  const int row = std::clamp(static_cast<int>((v + 0.5) / grid.block), 0, grid.rows - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
}

}  // namespace

void ResidualWeightOptions::check() const {
  require(columns >= 1 && columns <= 1000, "residual_weights.columns", "1 to 1000");
  require(noise > 0.0, "residual_weights.noise", "positive");
  require(outlier >= noise, "residual_weights.outlier", "at least noise");
  require(prior > 0.0, "residual_weights.prior", "positive");
}

double ResidualWeights::at(double u, double v) const { return weight[block_at(*this, u, v)]; }

ResidualWeights residual_weights(const Camera& camera, const std::vector<BrightnessSample>& samples,
                                 const ResidualWeightOptions& options) {
  ResidualWeights grid;
  grid.block = static_cast<double>(camera.width) / options.columns;
  grid.columns = options.columns;
  grid.rows = static_cast<int>(std::ceil(camera.height / grid.block));
  const auto blocks = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  const double noise2 = options.noise * options.noise;
  std::vector<double> squares(blocks, options.prior * noise2);
  std::vector<double> points(blocks, options.prior);
  for (const BrightnessSample& sample : samples) {
    const std::size_t b = block_at(grid, sample.u, sample.v);
    const double r = std::min(std::abs(sample.residual), options.outlier);
    squares[b] += r * r;
    points[b] += 1.0;
  }
  grid.weight.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) grid.weight[b] = std::min(1.0, noise2 * points[b] / squares[b]);
  return grid;
}

}  // namespace odosplat
