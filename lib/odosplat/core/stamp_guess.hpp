// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat {

/// Stamps of one list of poses or images, ascending, and what it is called in a sentence ("the estimate").
struct NamedStamps {
  std::string name;
  std::vector<double> times;  // meant to be [s]
};

/// Why two lists that should be of the same time do not match within `tolerance` [s], as a clause for the user:
/// a list in ms, us or ns, a list of frame numbers, or a constant offset. A unit counts if half of the shorter list
/// matches with it, or if the two last for times that differ by its factor. The words say "look like" or "about": it is
/// a guess. Two lists that overlap and have no such fault: how far the nearest stamps are apart (median). Empty if one
/// of them is.
std::string guess_stamp_fault(const NamedStamps& a, const NamedStamps& b, double tolerance);

/// Unit (ms, us, ns) that times look like which are `step` apart (median) where seconds were meant; empty for steps of
/// less than 10 s.
std::string unit_of_step(double step);

}  // namespace odosplat
