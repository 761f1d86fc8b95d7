// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace odosplat {

/// One curve. It is interrupted where the error is not finite and where the time step is more than 2.5 times the median
/// step (lost frames).
struct ErrorSeries {
  std::string name;
  std::vector<double> times;   // [s], ascending
  std::vector<double> errors;  // [m], as many as times
};

/// Errors over time, of one run or of several methods.
struct ErrorPlot {
  cv::Size size{1600, 0};  // [px]; height 0: 0.55 of the width
  std::vector<ErrorSeries> series;
  bool log_scale = false;       // for methods whose errors differ by powers of ten; errors <= 0 interrupt the curve
  std::string words = "error";  // label of the y axis; its unit is added
  std::string title;
};

/// Draws the plot: R, G, B, of the given size, on white. Curves differ in colour and, for greyscale prints, every
/// second one is dashed. Time is counted from the earliest time of all series. A logarithmic scale begins at a round
/// value at or below the 1 % quantile of the errors; smaller errors are drawn at its lower end. No series, or none with
/// values, gives empty axes. Same input, same bytes. Needs no OpenGL. Any thread. Throws InputError for an invalid size
/// or arrays of different lengths.
cv::Mat3b draw_error_plot(const ErrorPlot& plot);

}  // namespace odosplat
