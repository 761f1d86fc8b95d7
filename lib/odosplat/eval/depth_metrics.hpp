// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

struct DepthErrors {
  double median_abs_m = 0.0;  // of |estimate - truth| [m]
  double p90_m = 0.0;         // 90 % of the errors are no larger
  double rmse_m = 0.0;        // [m]
  double mean_m = 0.0;        // [m] of estimate - truth: positive = too far
  double valid_share = 0.0;   // share of the pixels with truth that have an estimate
  std::uint64_t pixels = 0;   // number with truth
  // Share of the estimates with a sigma whose error is within 1, 2 and 3 sigma (0.683, 0.954, 0.997 for a normal
  // distribution); 0 without sigmas.
  double within_sigmas[3] = {0.0, 0.0, 0.0};
  std::uint64_t with_sigma = 0;  // number of estimates with a sigma
};

/// Errors of depth images over many frames, with constant memory: sums, and a histogram of the absolute error with 2000
/// bins per decade from 1 um to 100 m (errors beyond count in the first or last bin), so that median and p90 are exact
/// to 0.06 %. Use one object per region (all pixels, selected ones, those near edges). Not thread safe; the order of
/// frames affects the result only through the rounding of sums.
class DepthMetrics {
 public:
  DepthMetrics();

  /// estimate and truth [m], 0 = none; only pixels where mask is not 0 count (an empty mask: all). sigma [m]: standard
  /// deviation of the estimate, 0 = unknown (an empty image: everywhere). Throws InputError if sizes differ.
  void add(const DepthImage& estimate, const DepthImage& truth, const cv::Mat1b& mask = {},
           const cv::Mat1f& sigma = {});

  /// All 0 if there was no truth.
  DepthErrors result() const;

 private:
  double quantile(double share) const;

  std::vector<std::uint64_t> bins_;
  std::uint64_t pixels_ = 0;
  std::uint64_t valid_ = 0;
  double sum_ = 0.0;
  double squares_ = 0.0;
  std::uint64_t with_sigma_ = 0;
  std::uint64_t within_[3] = {0, 0, 0};
};

/// 255 within radius [px] (along rows and columns) of a depth edge, else 0. An edge lies between two neighbouring
/// pixels whose depths differ by more than min_step times the smaller one; pixels without depth make no edge.
cv::Mat1b depth_edge_mask(const DepthImage& depth, int radius = 3, double min_step = 0.05);

}  // namespace odosplat
