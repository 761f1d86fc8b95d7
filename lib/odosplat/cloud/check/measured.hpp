// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "odosplat/core/jackknife.hpp"

namespace odosplat {

/// A value and its standard deviation.
struct Measured {
  double value = 0.0;
  double sigma = 0.0;
};

/// sigma: the larger of the formal one and that of a jackknife, plus a floor for errors that more data do not reduce.
/// without: the values without one group of the data each.
inline Measured with_sigma(double value, double formal, double floor, const std::vector<double>& without) {
  return {value, std::hypot(floor, std::max(formal, jackknife_sigma(without)))};
}

}  // namespace odosplat
