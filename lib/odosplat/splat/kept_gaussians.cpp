// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/kept_gaussians.hpp"

#include <algorithm>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

/// Of `values`, with `width` values per row, the rows to keep.
std::vector<float> rows_to_keep(const std::vector<float>& values, const std::vector<bool>& keep, std::size_t width) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i * width);
    kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return kept;
}

void append_values(std::vector<float>& values, const std::vector<float>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

Gaussians kept_gaussians(const Gaussians& gaussians, const std::vector<bool>& keep) {
  require(keep.size() == gaussians.size(), "keep", "one per Gaussian");
  Gaussians kept;
  kept.sh_degree = gaussians.sh_degree;
  kept.positions = rows_to_keep(gaussians.positions, keep, 3);
  kept.log_scales = rows_to_keep(gaussians.log_scales, keep, 3);
  kept.rotations = rows_to_keep(gaussians.rotations, keep, 4);
  kept.opacity_logits = rows_to_keep(gaussians.opacity_logits, keep, 1);
  kept.sh = rows_to_keep(gaussians.sh, keep, 3 * static_cast<std::size_t>(gaussians.coefficients()));
  return kept;
}

Gaussians with_sh_degree(const Gaussians& gaussians, int degree) {
  require(degree >= gaussians.sh_degree && degree <= 3, "degree", "at least that of the Gaussians and at most 3");
  Gaussians padded = gaussians;
  padded.sh_degree = degree;
  padded.sh.assign(3 * gaussians.size() * static_cast<std::size_t>(padded.coefficients()), 0.0F);
  const auto from = static_cast<std::ptrdiff_t>(3 * gaussians.coefficients());
  const auto to = static_cast<std::ptrdiff_t>(3 * padded.coefficients());
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(gaussians.size()); ++i) {
    std::copy_n(gaussians.sh.begin() + i * from, from, padded.sh.begin() + i * to);
  }
  return padded;
}

void append_gaussians(Gaussians& gaussians, const Gaussians& more) {
  const int degree = std::max(gaussians.sh_degree, more.sh_degree);
  if (gaussians.sh_degree < degree) gaussians = with_sh_degree(gaussians, degree);
  append_values(gaussians.positions, more.positions);
  append_values(gaussians.log_scales, more.log_scales);
  append_values(gaussians.rotations, more.rotations);
  append_values(gaussians.opacity_logits, more.opacity_logits);
  append_values(gaussians.sh, more.sh_degree < degree ? with_sh_degree(more, degree).sh : more.sh);
}

}  // namespace odosplat
