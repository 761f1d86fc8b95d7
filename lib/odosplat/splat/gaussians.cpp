// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/gaussians.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {

namespace {

std::string value_and_limit(const char* what, float value, float limit) {
  return formatted("%s is %.3g, beyond %.3g", what, static_cast<double>(value), static_cast<double>(limit));
}

}  // namespace

std::string undrawable_value(const Gaussians& gaussians, std::size_t i) {
  for (std::size_t a = 0; a < 3; ++a) {
    const float place = gaussians.positions[3 * i + a];
    if (!(std::abs(place) <= gaussian_limits::place)) {
      return value_and_limit("its position [m]", place, gaussian_limits::place);
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const float scale = gaussians.log_scales[3 * i + a];
    if (!(scale <= gaussian_limits::log_scale)) {
      return value_and_limit("its scale [ln m]", scale, gaussian_limits::log_scale);
    }
  }
  double squared = 0.0;
  for (std::size_t a = 0; a < 4; ++a) squared += std::pow(static_cast<double>(gaussians.rotations[4 * i + a]), 2);
  const auto length = static_cast<float>(std::sqrt(squared));
  if (!(length >= gaussian_limits::least_rotation)) return "its rotation has length 0";
  if (!(length <= gaussian_limits::rotation)) {
    return value_and_limit("the length of its rotation", length, gaussian_limits::rotation);
  }
  const auto width = 3 * static_cast<std::size_t>(gaussians.coefficients());
  for (std::size_t k = 0; k < width; ++k) {
    const float color = gaussians.sh[width * i + k];
    if (!(std::abs(color) <= gaussian_limits::color)) {
      return value_and_limit("its colour", color, gaussian_limits::color);
    }
  }
  return {};
}

void Gaussians::resize(std::size_t n) {
  positions.resize(3 * n);
  log_scales.resize(3 * n);
  rotations.resize(4 * n);
  opacity_logits.resize(n);
  sh.resize(3 * n * static_cast<std::size_t>(coefficients()));
}

void Gaussians::check() const {
  require(sh_degree >= 0 && sh_degree <= 3, "sh_degree", "0 to 3");
  const std::size_t n = size();
  require(positions.size() == 3 * n, "positions", "three per Gaussian");
  require(log_scales.size() == 3 * n, "log_scales", "three per Gaussian");
  require(rotations.size() == 4 * n, "rotations", "four per Gaussian");
  require(sh.size() == 3 * n * static_cast<std::size_t>(coefficients()), "sh", "3 (sh_degree + 1)^2 per Gaussian");
}

}  // namespace odosplat
