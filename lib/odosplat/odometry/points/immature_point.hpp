// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/odometry/points/residual_pattern.hpp"

namespace odosplat {

/// What came of the last search for a point.
enum class SearchStatus {
  untried,
  good,         // found: the interval has narrowed
  certain,      // the interval is shorter than what can be searched: left as it is
  uncertain,    // a match would not narrow the interval: a short line, or one that runs along an edge
  outlier,      // nothing along the line looks like the point
  out_of_view,  // the line, or the pattern on it, leaves the image
};

/// A pixel whose depth is not known yet, only that its inverse depth lies in an interval; every tracked frame narrows
/// it (DSO's immature points). Data only.
struct ImmaturePoint {
  float u = 0.0F;  // [px] in its host
  float v = 0.0F;
  double min_q = 0.0;  // [1/m] interval of inverse depth
  double max_q = 0.0;
  SearchStatus status = SearchStatus::untried;
  double length = 0.0;                               // [px] of the interval in the last image searched
  double quality = 0.0;                              // of the last match: second-best cost over best
  bool of_map = false;                               // the interval is from the map's depth
  int found = 0;                                     // times that a match narrowed the interval
  int outliers = 0;                                  // times in a row that nothing looked like it
  Eigen::Matrix2f tensor = Eigen::Matrix2f::Zero();  // sum over the pattern of gradient gradient^T [grey^2 / px^2]
  float intensity[pattern_size] = {};                // [grey]
  float weight[pattern_size] = {};                   // gradient-dependent, 0..1
};

}  // namespace odosplat
