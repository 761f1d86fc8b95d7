// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <string>

namespace odosplat {

/// A possible mix-up of units: the coordinates of a cloud are `times` as large as those of the poses because of
/// `words`.
struct CoordinateUnit {
  double times;
  const char* words;
};

extern const std::array<CoordinateUnit, 7> length_units;

/// "the cloud is in mm" for 1000; empty if the factor of no unit is within 2 % of `times`.
std::string unit_words(double times);

}  // namespace odosplat
