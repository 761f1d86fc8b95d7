// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/tremor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace odosplat {

Tremor::Tremor(Random& random, double duration, bool closed) {
  double power = 0.0;
  for (int i = 0; i < 24; ++i) {
    double frequency = 0.3 * std::pow(9.0 / 0.3, (i + random.uniform()) / 24.0);
    if (closed) frequency = std::max(1.0, std::round(frequency * duration)) / duration;
    const double roll_off = 1.0 + std::pow(frequency / 3.0, 4.0);
    const double amplitude = 1.0 / (frequency * std::sqrt(roll_off));
    waves_.push_back({frequency, amplitude, random.uniform(0.0, 2.0 * std::numbers::pi)});
    power += 0.5 * amplitude * amplitude;
  }
  for (Wave& w : waves_) w.amplitude /= std::sqrt(power);
}

double Tremor::operator()(double time) const {
  double sum = 0.0;
  for (const Wave& w : waves_) sum += w.amplitude * std::sin(2.0 * std::numbers::pi * w.frequency * time + w.phase);
  return sum;
}

}  // namespace odosplat
