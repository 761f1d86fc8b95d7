// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/points/immature_point.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

struct EpipolarSearchOptions {
  double max_length = 0.06;          // of width + height: no search is longer
  double min_length = 1.5;           // [px] shorter intervals are known well enough
  double huber = residual_huber;     // [grey]
  double outlier = pattern_outlier;  // [grey] the best match may differ this much on average
  double location_error = 0.2;       // [px] of a match along a line that runs with the gradient
  double max_error = 10.0;           // [px] matches less certain are useless
  double min_scale = 0.66;           // of the pattern between the two images; beyond, it no longer looks the same
  double max_scale = 1.5;
  int distinct_radius = 2;  // [px] least distance between the best match and the one that counts as second best

  void check() const;
};

struct SearchResult {
  SearchStatus status = SearchStatus::untried;
  double min_q = 0.0;  // [1/m] the interval afterwards
  double max_q = 0.0;
  double length = 0.0;   // [px] of the interval in the image that was searched
  double quality = 0.0;  // second-best cost over best: how distinct the match is; 0 if nothing was searched
};

/// Searches a pixel of a host along its epipolar line in another image, for inverse depths min_q to max_q.
/// Source: Engel, Sturm, Cremers 2013 and DSO: steps of one pixel over the 8-pixel pattern, the best one refined by
/// Gauss-Newton along the line; error along the line from the angle between line and gradient. If the line is longer
/// than max_length, only its far end is searched. brightness: the target's relative to the host's. Pure function.
SearchResult search_epipolar_line(const ImmaturePoint& point, const SE3& T_target_host, const Camera& camera,
                                  const GrayImage& target, const Brightness& brightness,
                                  const EpipolarSearchOptions& options);

}  // namespace odosplat
