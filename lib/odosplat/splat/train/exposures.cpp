// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/exposures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/constants.h"
#include "odosplat/core/error.hpp"

namespace odosplat {

using compute::Range;

namespace {
constexpr double beta1 = 0.9;
constexpr double beta2 = 0.999;
}  // namespace

void ExposureOptions::check() const {
  require(rate >= 0.0 && std::isfinite(rate), "exposure_rate", "at least 0");
  require(steadiness >= 0.0 && std::isfinite(steadiness), "exposure_steadiness", "at least 0");
}

Exposures::Exposures(const compute::Context& context, const ExposureOptions& options, int views)
    : options_((options.check(), options)),
      context_(context),
      expose_(compute::Program(context, {"exposure.cl"}).kernel("expose", "loss")),
      backward_(compute::Program(context, {"exposure.cl"}).kernel("expose_backward", "loss")),
      state_(row * static_cast<std::size_t>(views), 0.0) {
  for (std::size_t v = 0; v < static_cast<std::size_t>(views); ++v)
    std::fill_n(state_.begin() + static_cast<std::ptrdiff_t>(v * row), 3, 1.0);
}

std::array<double, Exposures::settings> Exposures::of(int view) const {
  std::array<double, settings> values{};
  std::copy_n(state_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(view) * row), settings,
              values.begin());
  return values;
}

std::array<float, 8> Exposures::kernel_settings(int view) const {
  std::array<float, 8> values{};
  const auto exact = of(view);
  std::transform(exact.begin(), exact.end(), values.begin(), [](double v) { return static_cast<float>(v); });
  return values;
}

void Exposures::apply(int view, const compute::Buffer<float>& rendered, compute::Buffer<float>& exposed) {
  exposed.resize(context_, rendered.size());
  const std::size_t pixels = rendered.size() / 3;
  expose_(Range::linear(pixels, ITEM_GROUP), static_cast<std::int32_t>(pixels), rendered, kernel_settings(view),
          exposed);
}

void Exposures::backward(int view, const compute::Buffer<float>& rendered, int width, int height,
                         compute::Buffer<float>& gradient) {
  rows_.resize(context_, settings * static_cast<std::size_t>(height));
  const std::array<float, 8> gains = kernel_settings(view);
  for (std::int32_t channel = 0; channel < 3; ++channel)
    backward_(Range::linear(static_cast<std::size_t>(height), 8), std::int32_t{width}, std::int32_t{height}, channel,
              gains[static_cast<std::size_t>(channel)], rendered, gradient, rows_);
  const std::vector<float> rows = rows_.download();
  double* mine = &state_[static_cast<std::size_t>(view) * row];
  double* first = mine + settings;
  double* second = first + settings;
  const double steps = ++mine[row - 1];
  for (std::size_t k = 0; k < settings; ++k) {
    double slope = 0.0;
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
      slope += static_cast<double>(rows[k * static_cast<std::size_t>(height) + y]);
    slope += 2.0 * options_.steadiness * (mine[k] - (k < 3 ? 1.0 : 0.0)) / static_cast<double>(settings);
    first[k] = beta1 * first[k] + (1.0 - beta1) * slope;
    second[k] = beta2 * second[k] + (1.0 - beta2) * slope * slope;
    mine[k] -= options_.rate * (first[k] / (1.0 - std::pow(beta1, steps))) /
               (std::sqrt(second[k] / (1.0 - std::pow(beta2, steps))) + 1e-12);
  }
}

void Exposures::check_state(const std::vector<double>& state, int iterations) const {
  require(state.size() == state_.size(), "exposures", "those of " + std::to_string(state_.size() / row) + " views");
  double steps = 0.0;
  for (std::size_t at = 0; at < state.size(); at += row) {
    const double* mine = &state[at];
    require(std::all_of(mine, mine + row, [](double v) { return std::isfinite(v); }), "exposures", "finite");
    require(std::all_of(mine + 2 * settings, mine + 3 * settings, [](double v) { return v >= 0.0; }), "exposures",
            "without negative means of squares");
    require(mine[row - 1] >= 0.0 && mine[row - 1] == std::floor(mine[row - 1]), "exposures",
            "of whole numbers of steps");
    steps += mine[row - 1];
  }
  require(steps == (on() ? iterations : 0), "exposures", "with one step per iteration in total");
}

void Exposures::set_state(const std::vector<double>& state, int iterations) {
  check_state(state, iterations);
  state_ = state;
}

}  // namespace odosplat
