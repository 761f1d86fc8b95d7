// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// What `view depth` shows: a depth image with its scale and, where given, colour, sigma and alpha beside it.
struct DepthFigure {
  cv::Size size{1200, 0};  // [px]; height 0: as the panels need
  DepthImage depth;        // [m], 0 or not finite = none
  ColorImage color;        // may be empty
  cv::Mat1f sigma;         // [m], may be empty; 0 = none
  cv::Mat1f alpha;         // 0..1, may be empty
  double depth_min = 0.0;  // [m] ends of the depth scale; both 0: from the image, stray values aside
  double depth_max = 0.0;  // [m]
  double sigma_max = 0.0;  // [m] end of the sigma scale; 0: from the image
  std::string title;       // one line
};

/// Ends of a scale [m].
struct ValueRange {
  double low = 0.0;
  double high = 1.0;
};

/// Range of the valid values (> 0, finite): 0.5 % to 99.5 % of them, a little wider, and never empty. {0, 1} without
/// any.
ValueRange depth_range_of(const std::vector<const cv::Mat1f*>& images);

/// Draws the figure: R, G, B, of the size asked for, on white; each panel with its name and, if it holds figures, its
/// scale in metres below; pixels without depth are hatched in grey. Two panels or more stand in two columns.
/// An empty depth image gives a hatched panel. Same input, same bytes. Needs no OpenGL. Any thread.
/// Throws InputError for a bad size or for images of different sizes.
cv::Mat3b draw_depth(const DepthFigure& figure);

}  // namespace odosplat
