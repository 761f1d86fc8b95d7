// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "tests/accuracy/world.hpp"

namespace odosplat::accuracy {

/// A rule of the odometry that can be switched off, to see what it is worth.
struct Rule {
  const char* name;
  OptionEdit off;
  // Factor of the images' grey values while the rule is off. Below 1 it keeps pixels from counting as clipped, for
  // which there is no option.
  double gain = 1.0;
};

/// All rules, by the part of the odometry that they belong to.
const std::vector<Rule>& rules();

}  // namespace odosplat::accuracy
