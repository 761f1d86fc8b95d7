// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

struct SelectorOptions {
  int block = 32;              // [px] side of the regions that get a threshold of their own
  double quantile = 0.5;       // of a region's gradient norms: the base of its threshold
  double offset = 7.0 / 255;   // [grey/px] added to it, so that noise alone is never picked
  double level_factor = 0.75;  // threshold factor a pyramid level up
  int border = 5;              // [px] no pixel is picked nearer to the image's edge
  std::uint64_t seed = 3141592;

  /// Throws InputError naming the field.
  void check() const;
};

/// For bare images: picks weak gradients of plaster and of shading, as far as they exceed the noise.
inline SelectorOptions weak_selector_options() {
  SelectorOptions options;
  options.quantile = 0.1;
  options.offset = 0.5 / 255;
  options.level_factor = 0.6;
  return options;
}

/// Picks pixels of high gradient, spread over the image: thresholds adapt to the region, and the cell size adapts so
/// that about as many pixels are found as wanted.
/// Source: Engel, Koltun, Cremers 2018 (DSO), section 3.2: region threshold = median gradient + offset, smoothed over
/// 3x3 regions; in each cell of side d the pixel of the largest gradient along a random direction; where a cell of 2d
/// (4d) finds none, a weaker one judged on the next coarser gradients. Differs: pixels outside `mask` are ignored. The
/// same input gives the same pixels; the call keeps the last cell size as first guess, so order of calls matters. Not
/// thread safe (scratch memory).
class PixelSelector {
 public:
  explicit PixelSelector(const SelectorOptions& options);

  /// gradients: the image itself first, then up to two coarser levels. mask: empty, or of the image's size and not 0
  /// where a pixel may be picked. Returns at most 1.25 * wanted pixels, in scan order of cells; none for a blank image.
  std::vector<cv::Point> select(std::span<const GradientImage> gradients, const cv::Mat1b& mask, int wanted);

  /// Gradient norm [grey/px] a pixel must exceed, one value a region: rows x cols of regions. For tests and figures.
  cv::Mat1f thresholds(const GradientImage& gradient) const;

 private:
  /// One byte per pixel: a bit for each of up to three levels whose gradient there is above the pixel's threshold. 0
  /// where no pixel may be picked.
  cv::Mat1b candidates(std::span<const GradientImage> gradients, const cv::Mat1b& mask) const;
  std::vector<cv::Point> pick(std::span<const GradientImage> gradients, const cv::Mat1b& levels, int cell) const;

  SelectorOptions options_;
  int cell_ = 3;
};

}  // namespace odosplat
