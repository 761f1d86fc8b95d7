// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/length_units.hpp"

#include <cmath>

namespace odosplat {
namespace {

constexpr double same_unit = 0.02;

}  // namespace

const std::array<CoordinateUnit, 7> length_units{{{1000.0, "the cloud is in mm"},
                                                  {100.0, "the cloud is in cm"},
                                                  {1.0 / 0.0254, "the cloud is in inches"},
                                                  {1.0 / 0.3048, "the cloud is in feet"},
                                                  {0.3048, "the poses are in feet"},
                                                  {0.01, "the poses are in cm"},
                                                  {0.001, "the poses are in mm"}}};

std::string unit_words(double times) {
  for (const CoordinateUnit& unit : length_units) {
    if (std::abs(times / unit.times - 1.0) < same_unit) return unit.words;
  }
  return "";
}

}  // namespace odosplat
