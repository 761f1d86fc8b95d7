// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/random.hpp"

namespace odosplat {

/// One coordinate of a hand's tremor, of variance 1 over time: a sum of sines of random phase from 0.3 to 9 Hz, whose
/// power falls with frequency squared below 3 Hz (sway) and faster above, as measured for hand-held cameras.
/// duration [s]: on a closed path each wave comes back to its start after it.
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
