// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

namespace odosplat::apps {

/// Percentiles and maximum of durations, in memory that is bounded: all values up to 262 144, beyond that every second
/// one, every fourth, and so on, evenly over the whole run.
class DurationSamples {
 public:
  void add(double value);
  /// percent: 0..100, as percentile(); 0 without values.
  std::vector<double> percentiles(const std::vector<double>& percents) const;
  /// Of all values; 0 without values.
  double most() const { return most_; }

 private:
  static constexpr std::size_t capacity = 262'144;

  std::vector<double> values_;
  std::size_t stride_ = 1;   // one value of so many is kept
  std::size_t skipped_ = 0;  // since the last one kept
  double most_ = 0.0;
};

}  // namespace odosplat::apps
