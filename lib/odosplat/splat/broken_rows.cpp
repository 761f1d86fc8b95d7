// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/broken_rows.hpp"

#include <algorithm>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat {
namespace {

constexpr std::size_t most_in = 10;  // of this many rows at most one may be broken

void keep_rows(const std::vector<bool>& is_broken, std::size_t width, std::vector<float>& values) {
  auto to = values.begin();
  for (std::size_t i = 0; i < is_broken.size(); ++i) {
    if (is_broken[i]) continue;
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(i * width);
    to = std::copy_n(from, width, to);
  }
  values.erase(to, values.end());
}

}  // namespace

void BrokenRows::add(std::size_t i, const std::string& fault) {
  if (is_broken_[i]) return;
  is_broken_[i] = true;
  ++broken_;
  if (broken_ > 1) return;
  first_place_ = "Gaussian " + std::to_string(i);
  first_fault_ = fault;
}

void BrokenRows::leave_out(Gaussians& gaussians) {
  for (std::size_t i = 0; i < is_broken_.size(); ++i) {
    if (is_broken_[i]) continue;
    const std::string fault = undrawable_value(gaussians, i);
    if (!fault.empty()) add(i, fault);
  }
  if (broken_ == 0) return;
  const std::string of_all = std::to_string(broken_) + " of " + std::to_string(is_broken_.size()) + " Gaussians";
  if (broken_ * most_in > is_broken_.size()) {
    throw InputError(name_, first_place_, first_fault_ + (broken_ > 1 ? "; " + of_all + " are broken" : ""));
  }
  keep_rows(is_broken_, 3, gaussians.positions);
  keep_rows(is_broken_, 3, gaussians.log_scales);
  keep_rows(is_broken_, 4, gaussians.rotations);
  keep_rows(is_broken_, 1, gaussians.opacity_logits);
  keep_rows(is_broken_, 3 * static_cast<std::size_t>(gaussians.coefficients()), gaussians.sh);
  log_warning(name_ + ": " + of_all + " are broken and left out (" + first_place_ + ": " + first_fault_ + ")");
}

}  // namespace odosplat
