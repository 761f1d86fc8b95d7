// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/duration_samples.hpp"

#include <algorithm>

#include "odosplat/eval/statistics.hpp"

namespace odosplat::apps {

void DurationSamples::add(double value) {
  most_ = std::max(most_, value);
  if (++skipped_ < stride_) return;
  skipped_ = 0;
  values_.push_back(value);
  if (values_.size() < capacity) return;
  for (std::size_t i = 0; 2 * i < values_.size(); ++i) values_[i] = values_[2 * i];
  values_.resize(values_.size() / 2);
  stride_ *= 2;
}

std::vector<double> DurationSamples::percentiles(const std::vector<double>& percents) const {
  std::vector<double> sorted = values_;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> found;
  found.reserve(percents.size());
  for (const double percent : percents) found.push_back(percentile(sorted, percent));
  return found;
}

}  // namespace odosplat::apps
