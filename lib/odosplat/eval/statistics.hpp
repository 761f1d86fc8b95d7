// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

namespace odosplat {

/// Statistics of a list of errors, in the errors' unit. All 0 for an empty list.
struct Statistics {
  std::size_t count = 0;
  double rmse = 0.0;  // sqrt(mean of squares)
  double mean = 0.0;
  double median = 0.0;  // for an even count the mean of the two middle values
  double min = 0.0;
  double max = 0.0;
  double p99 = 0.0;                 // see percentile()
  double standard_deviation = 0.0;  // around the mean, divided by count (not count - 1)
};

Statistics statistics(const std::vector<double>& values);

/// Percentile (percent: 0..100) of a list in ascending order: the value at position percent/100 * (n - 1), counted from
/// 0, with linear interpolation between neighbours (numpy's default, type 7 of Hyndman and Fan 1996). 0 for an empty
/// list.
double percentile(const std::vector<double>& sorted, double percent);

}  // namespace odosplat
