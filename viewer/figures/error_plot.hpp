// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace odosplat {

/// One curve. Breaks where the error is not finite and where time jumps by more than two and a half of its usual steps
/// (frames that were lost).
struct ErrorSeries {
  std::string name;
  std::vector<double> times;   // [s], ascending
  std::vector<double> errors;  // [m], as many
};

/// Errors over time, of one run or of several methods side by side.
struct ErrorPlot {
  cv::Size size{1600, 0};  // [px]; height 0: 0.55 of the width
  std::vector<ErrorSeries> series;
  bool log_scale = false;  // for methods whose errors differ by powers of ten; needs errors > 0, others break the curve
  std::string words = "error";  // what the y axis shows; its unit is added
  std::string title;
};

/// Draws the plot: R, G, B, of the size asked for, on white. Curves differ in colour and, for grey prints, in dashes;
/// time starts at its smallest value over all series. A logarithmic scale ends below at a round figure under 99 % of
/// the errors; smaller ones are drawn at its end. No series, or none with values, gives empty axes. Same input, same
/// bytes. Needs no OpenGL. Any thread. Throws InputError for a bad size or arrays of different lengths.
cv::Mat3b draw_error_plot(const ErrorPlot& plot);

}  // namespace odosplat
