// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace odosplat {

double percentile(const std::vector<double>& sorted, double percent) {
  if (sorted.empty()) return 0.0;
  const double place = std::clamp(percent, 0.0, 100.0) / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = place - static_cast<double>(below);
  return (1.0 - share) * sorted[below] + share * sorted[above];
}

Statistics statistics(const std::vector<double>& values) {
  Statistics s;
  s.count = values.size();
  if (values.empty()) return s;
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  s.mean = sum / n;
  s.rmse = std::sqrt(squares / n);
  double deviations = 0.0;
  for (const double v : values) deviations += (v - s.mean) * (v - s.mean);
  s.standard_deviation = std::sqrt(deviations / n);
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  s.min = sorted.front();
  s.max = sorted.back();
  s.median = percentile(sorted, 50.0);
  s.p99 = percentile(sorted, 99.0);
  return s;
}

}  // namespace odosplat
