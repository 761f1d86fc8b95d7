// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/pair_scores.hpp"

namespace odosplat {

/// One way to read the data.
struct Convention {
  int fy_sign = 1;
  bool inverted = false;  // the stored poses are T_camera_world
  int id_shift = 0;       // image k belongs to the pose stored for image k + id_shift; -1, 0 or +1
  double depth_scale = 1.0;
  bool operator==(const Convention&) const = default;
};

/// A row of the table: how well the images agree under a convention.
/// Its relative errors are medians of |difference| / depth.
struct ConventionRow : PairScores {
  Convention convention;
  double error_m = 0.0;  // [m] median over pairs of the pair's median |difference|, in the row's own metres
  double overlap = 0.0;  // mean share of pixels that land on depth
};

/// What is said of one part of the convention.
struct ConventionFinding {
  std::string part;         // "fy", "poses", "id shift", "depth scale"
  bool decided = false;     // the data tell this from every other value
  bool as_declared = true;  // the value of the best row that cannot be told from the very best
  std::string text;         // one sentence, empty if decided and as declared
};

struct ConventionReport {
  std::vector<ConventionRow> rows;  // best first, by relative error
  Convention declared;
  Convention winner;
  double winner_error_m = 0.0;
  int gap = 0;                              // [frames] that was used: the smallest ...
  int max_gap = 0;                          // ... and the largest
  int pairs = 0;                            // that were used
  bool gap_reduced = false;                 // at the gap that was asked for nothing fitted
  bool believable = false;                  // the best error is below max_error
  bool as_declared = false;                 // believable, and no part is found to differ
  std::vector<ConventionFinding> findings;  // one a part
  std::string verdict;                      // one line: whether the declared convention holds, and what does if not
};

}  // namespace odosplat
