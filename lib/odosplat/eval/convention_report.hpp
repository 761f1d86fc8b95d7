// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/pair_scores.hpp"

namespace odosplat {

/// One interpretation of the data.
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
  double error_m = 0.0;  // [m] median over pairs of the pair's median |difference|, in metres by the row's depth scale
  double overlap = 0.0;  // mean share of pixels that are projected onto a pixel with depth
};

/// The result for one part of the convention.
struct ConventionFinding {
  std::string part;         // "fy", "poses", "id shift", "depth scale"
  bool decided = false;     // the data rule out every other value
  bool as_declared = true;  // the winner has the declared value
  std::string text;         // one sentence, empty if decided and as declared
};

struct ConventionReport {
  std::vector<ConventionRow> rows;  // best first, by relative error
  Convention declared;
  Convention winner;
  double winner_error_m = 0.0;
  int gap = 0;                              // [frames] smallest gap that was used
  int max_gap = 0;                          // [frames] largest gap that was used
  int pairs = 0;                            // number that was used
  bool gap_reduced = false;                 // a smaller gap than the requested one was used
  bool believable = false;                  // the winner's relative error is at most max_error
  bool as_declared = false;                 // believable, and the winner is the declared convention
  std::vector<ConventionFinding> findings;  // one per part
  std::string verdict;                      // one line: whether the declared convention holds, and if not, which one
};

}  // namespace odosplat
