// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

namespace odosplat {

/// Seeded random numbers that are the same on every platform (the distributions of <random> are not).
/// Generator: xoshiro256** of Blackman and Vigna 2018, seeded through splitmix64. Not thread safe.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  std::uint64_t next_u64();
  /// Uniform in [0, 1).
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, n), n > 0, without modulo bias.
  std::uint32_t below(std::uint32_t n);
  /// Normal with mean 0, standard deviation 1 (Box-Muller).
  double normal();

 private:
  std::uint64_t state_[4];
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace odosplat
