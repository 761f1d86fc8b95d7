// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/pair_scores.hpp"

#include <algorithm>
#include <cmath>

namespace odosplat {
namespace {

constexpr double clear_ratio = 3.0;
constexpr double least_ratio = 1.05;
constexpr double deviations = 2.6;

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

bool beats(const PairScores& a, const PairScores& b) {
  if (!std::isfinite(a.relative_error) || !b.tried) return false;
  if (!std::isfinite(b.relative_error)) return true;
  std::vector<double> errors_a;
  std::vector<double> errors_b;
  int won = 0;
  int lost = 0;
  for (std::size_t i = 0; i < a.pair_errors.size(); ++i) {
    if (std::isnan(a.pair_errors[i]) || std::isnan(b.pair_errors[i])) continue;
    errors_a.push_back(a.pair_errors[i]);
    errors_b.push_back(b.pair_errors[i]);
    won += a.pair_errors[i] < b.pair_errors[i];
    lost += a.pair_errors[i] > b.pair_errors[i];
  }
  if (errors_a.empty()) return b.relative_error >= clear_ratio * a.relative_error;
  const double pairs = static_cast<double>(errors_a.size());
  const double median_a = median_of(std::move(errors_a));
  const double median_b = median_of(std::move(errors_b));
  if (median_b >= clear_ratio * median_a) return won > lost;
  return median_b >= least_ratio * median_a && won - lost >= deviations * std::sqrt(pairs);
}

}  // namespace odosplat
