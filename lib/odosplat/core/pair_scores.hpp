// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <vector>

namespace odosplat {

/// How well one way to read the data explains pairs of images. Every way is judged on the same pairs, in one order.
struct PairScores {
  double relative_error = std::numeric_limits<double>::infinity();  // median over pairs; infinite if too few overlap
  bool tried = false;                                               // there are poses for at least half the pairs
  std::vector<double> pair_errors;  // one a pair; NaN where the pair does not overlap or has no pose
};

/// The median, of an even count the mean of the two in the middle; infinite for an empty list.
double median_of(std::vector<double> values);

/// Whether a is better than b beyond chance: over the pairs that both have, it errs three times less, or 5 % less and
/// less on so many single pairs that chance is ruled out (2.6 standard deviations of a coin, so on 7 pairs at least). A
/// reading that no pair speaks for beats none; one that could not be tried is not beaten.
bool beats(const PairScores& a, const PairScores& b);

}  // namespace odosplat
