// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/random.hpp"

namespace odosplat {

/// One coordinate of a hand's tremor, with variance 1 over time: a sum of sines with random phases from 0.3 to 9 Hz,
/// whose power decreases with frequency squared below 3 Hz (sway) and faster above, as measured for hand-held cameras.
/// On a closed path every sine has a whole number of periods in `duration` [s].
class Tremor {
 public:
  Tremor(Random& random, double duration, bool closed);

  double operator()(double time) const;

 private:
  struct Wave {
    double frequency;  // [Hz]
    double amplitude;
    double phase;  // [rad]
  };
  std::vector<Wave> waves_;
};

}  // namespace odosplat
