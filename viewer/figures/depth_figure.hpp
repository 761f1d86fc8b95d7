// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Content of `view depth`: a depth image with its scale and, if given, colour, sigma and alpha beside it.
struct DepthFigure {
  cv::Size size{1200, 0};  // [px]; height 0: as needed by the panels
  DepthImage depth;        // [m], 0 or not finite = none
  ColorImage color;        // may be empty
  cv::Mat1f sigma;         // [m], may be empty; 0 = none
  cv::Mat1f alpha;         // 0..1, may be empty
  double depth_min = 0.0;  // [m] ends of the depth scale; both 0: from the image, without outliers
  double depth_max = 0.0;  // [m]
  double sigma_max = 0.0;  // [m] end of the sigma scale; 0: from the image
  std::string title;       // one line
};

/// Ends of a scale [m].
struct ValueRange {
  double low = 0.0;
  double high = 1.0;
};

/// Range of the valid values (> 0, finite) for a scale: the 0.5 % to 99.5 % quantiles, slightly widened, never empty.
/// {0, 1} if there are no valid values.
ValueRange depth_range_of(const std::vector<const cv::Mat1f*>& images);

/// Draws the figure: R, G, B, of the given size, on white. Each panel has its name above it and, if it shows values,
/// its scale below it; pixels without depth are hatched in grey. Two panels or more are arranged in two columns. An
/// empty depth image gives a hatched panel. Same input, same bytes. Needs no OpenGL. Any thread.
/// Throws InputError for an invalid size or for images of different sizes.
cv::Mat3b draw_depth(const DepthFigure& figure);

}  // namespace odosplat
