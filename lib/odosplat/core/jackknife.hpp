// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cmath>
#include <vector>

namespace odosplat {

/// Standard deviation of an estimate by a jackknife: from the estimates without one group of the data each. 0 for fewer
/// than two of them.
inline double jackknife_sigma(const std::vector<double>& without) {
  const double n = static_cast<double>(without.size());
  double mean = 0.0;
  for (const double v : without) mean += v / n;
  double squares = 0.0;
  for (const double v : without) squares += (v - mean) * (v - mean);
  return n > 1.0 ? std::sqrt((n - 1.0) / n * squares) : 0.0;
}

}  // namespace odosplat
