// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/gaussians.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {

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
  require(positions.size() == 3 * n, "positions", "three a Gaussian");
  require(log_scales.size() == 3 * n, "log_scales", "three a Gaussian");
  require(rotations.size() == 4 * n, "rotations", "four a Gaussian");
  require(sh.size() == 3 * n * static_cast<std::size_t>(coefficients()), "sh", "3 (sh_degree + 1)^2 a Gaussian");
}

}  // namespace odosplat
