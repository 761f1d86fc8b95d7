// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace odosplat {

/// The median; for an even number of values the larger of the two middle values. `if_none` if there are no values.
template <typename T>
T upper_median(std::vector<T> values, T if_none = T()) {
  if (values.empty()) return if_none;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace odosplat
