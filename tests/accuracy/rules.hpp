// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "tests/accuracy/world.hpp"

namespace odosplat::accuracy {

/// A rule of the odometry that can be switched off, to measure its benefit.
struct Rule {
  const char* name;
  OptionEdit off;
  // Factor of the images' grey values while the rule is off. A factor below 1 switches off the detection of clipped
  // pixels, for which there is no option.
  double gain = 1.0;
};

/// All rules, by the part of the odometry that they belong to.
const std::vector<Rule>& rules();

}  // namespace odosplat::accuracy
