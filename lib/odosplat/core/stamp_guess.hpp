// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat {

/// Time stamps of one list of poses or images, ascending, and how messages name the list ("the estimate").
struct NamedStamps {
  std::string name;
  std::vector<double> times;  // meant to be [s]
};

/// A guess, as a clause for a message, why two lists that should cover the same time do not match within `tolerance`
/// [s]: one list is in ms, us or ns, or holds frame numbers, or there is a constant offset. A unit is named if half of
/// the shorter list matches once it is applied, or if the durations of the lists differ by its factor. The clause says
/// "look like" or "about" because it is a guess. For lists that overlap and show none of these faults, it gives the
/// median distance of the nearest stamps. Empty if one of the lists is empty.
std::string guess_stamp_fault(const NamedStamps& a, const NamedStamps& b, double tolerance);

/// The unit (ms, us, ns) that time stamps meant to be in seconds probably have if their median step is `step`; empty
/// for steps of less than 10 s, which are plausible as seconds.
std::string unit_of_step(double step);

}  // namespace odosplat
