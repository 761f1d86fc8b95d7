// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "viewer/color_map.hpp"
#include "viewer/figure_view.hpp"
#include "viewer/page.hpp"

namespace odosplat {

/// A horizontal bar of a colour scale with round ticks beneath it and a line of words beneath those.
struct ColorBar {
  ColorScale scale = ColorScale::depth;
  double low = 0.0;    // in the unit of the words
  double high = 1.0;   // in the unit of the words
  std::string words;   // "depth (m)"
  double start = 0.0;  // colours of `low` and `high`, as shares of the scale
  double end = 1.0;
  bool more = false;  // values above `high` exist: the bar ends in a tip
  bool none = false;  // shows beside the words what "none" looks like
};

/// Part of the error scale that colours paths: the palest colours would vanish on a map, and a black line has to be
/// seen on the darkest.
inline constexpr double path_scale_start = 0.2;
inline constexpr double path_scale_end = 0.75;

/// Height of a colour bar drawn with this font [px].
double color_bar_height(double font);
/// The same without the line of words, for bars whose words stand elsewhere.
double color_bar_height_without_words(double font);
/// Draws it with its top-left corner at `at`; nothing is drawn outside at.x .. at.x + width.
void draw_color_bar(Page& page, const ColorBar& bar, cv::Point2d at, double width, double font, int pitch);

/// A bar of round length with that length written over it; left end at `at`, or right end with AlignX::right. It is at
/// most three tenths of the view wide.
void draw_scale_bar(Page& page, double pixels_per_metre, double view_width, cv::Point2d at, AlignX align, double font);

/// The world's axes as the view sees them, x, y and z, around `center` in a circle of `radius` [px].
void draw_axes(Page& page, const FigureView& view, cv::Point2d center, double radius, double font);

/// One entry of a legend: what it looks like and a word.
struct LegendEntry {
  enum class Mark { line, dashes, ring, gradient };
  Mark mark = Mark::line;
  Rgb color{0, 0, 0};
  double width = 2.0;  // [px] of the line
  std::string word;
};

/// Entries in rows, centred in at.x .. at.x + width, wrapped where they do not fit. Returns the height of all rows;
/// with page == nullptr it only measures.
double draw_legend(Page* page, const std::vector<LegendEntry>& entries, cv::Point2d at, double width, double font);

/// The ring that marks where a path starts.
void draw_start_ring(Page& page, cv::Point2d center, double radius);

}  // namespace odosplat
