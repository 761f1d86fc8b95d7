// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// A depth image with the name of its method.
struct NamedDepth {
  std::string name;  // "interpolated", "rendered"
  DepthImage depth;  // [m], 0 or not finite = none
};

/// One view of the comparison.
struct CompareExample {
  std::string name;                 // "icl_1, frame 120"; may be empty
  ColorImage image;                 // may be empty
  std::vector<NamedDepth> methods;  // one or more, the same names in every example
  DepthImage truth;                 // [m], 0 = none; may be empty: no errors then
};

/// Content of `view compare` (the paper's Figure 4): image | each method's depth | true depth, and below each method
/// its error. All depths have the same scale, and all errors.
struct CompareFigure {
  cv::Size size{2400, 0};                // [px]; height 0: as needed by the panels
  std::vector<CompareExample> examples;  // one or more
  double depth_min = 0.0;  // [m] ends of the depth scale; both 0: from the truth (without truth: from the methods)
  double depth_max = 0.0;  // [m]
  double error_max = 0.0;  // [m] end of the error scale; 0: the 90th percentile of the errors, rounded up
};

/// Draws the figure: R, G, B, of the given size, on white. Hatched in grey: pixels without depth, and pixels without
/// error because the method's or the true depth is missing. Under each error: median and RMSE over the pixels that have
/// both depths, and the share of the pixels with true depth for which the method has one. Text is at least 5 points if
/// the figure is printed one column (8.6 cm) wide. Same input, same bytes. Needs no OpenGL. Any thread.
/// Throws InputError for an invalid size, no examples, methods that differ between examples, images of different sizes.
cv::Mat3b draw_compare(const CompareFigure& figure);

}  // namespace odosplat
