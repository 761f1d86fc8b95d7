// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <vector>

namespace odosplat {

/// How well one interpretation of the data (for example one convention of poses) explains pairs of images. All
/// interpretations are scored on the same pairs in the same order.
struct PairScores {
  double relative_error = std::numeric_limits<double>::infinity();  // median over pairs; infinite if too few overlap
  bool tried = false;                                               // there are poses for at least half the pairs
  std::vector<double> pair_errors;  // one per pair; NaN where the pair does not overlap or has no pose
};

/// The median; for an even count the mean of the two middle values. Infinite for an empty list.
double median_of(std::vector<double> values);

/// Whether a is significantly better than b. Over the pairs for which both have an error, one of these must hold:
///   - a's median error is at most a third of b's, and a has the smaller error on more pairs than b;
///   - a's median error is smaller by 5 % at least, and a has the smaller error on so many more pairs that chance is
///     ruled out: 2.6 standard deviations of fair coin tosses, which takes 7 pairs at least.
/// An a without a finite relative error is never better; a b that was not tried is never beaten.
bool beats(const PairScores& a, const PairScores& b);

}  // namespace odosplat
