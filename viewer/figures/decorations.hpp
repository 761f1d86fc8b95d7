// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "viewer/color_map.hpp"
#include "viewer/figure_view.hpp"
#include "viewer/page.hpp"

namespace odosplat {

/// A horizontal bar of a colour scale with round ticks beneath it and a line of text beneath those.
struct ColorBar {
  ColorScale scale = ColorScale::depth;
  double low = 0.0;    // in the unit of the words
  double high = 1.0;   // in the unit of the words
  std::string words;   // "depth (m)"
  double start = 0.0;  // part of the colour scale that `low` and `high` correspond to, 0..1
  double end = 1.0;
  bool more = false;  // values above `high` exist: the bar ends in a tip
  bool none = false;  // adds a hatched sample with the word "none" beside the words
};

/// Part of the error scale used for paths: paler colours would not stand out from a map, and a black line would not be
/// visible on darker ones.
inline constexpr double path_scale_start = 0.2;
inline constexpr double path_scale_end = 0.75;

/// Height of a colour bar drawn with this font [px].
double color_bar_height(double font);
/// The same without the line of text, for bars whose text stands elsewhere.
double color_bar_height_without_words(double font);
/// Draws it with its top-left corner at `at`; nothing is drawn outside at.x .. at.x + width.
void draw_color_bar(Page& page, const ColorBar& bar, cv::Point2d at, double width, double font, int pitch);

/// Draws a bar of round length with that length written over it; its left end is at `at`, or its right end with
/// AlignX::right. It is at most three tenths of the view wide.
void draw_scale_bar(Page& page, double pixels_per_metre, double view_width, cv::Point2d at, AlignX align, double font);

/// Draws the world's axes x, y and z as seen in the view, around `center` in a circle of `radius` [px].
void draw_axes(Page& page, const FigureView& view, cv::Point2d center, double radius, double font);

/// One entry of a legend: a sample mark and a word.
struct LegendEntry {
  enum class Mark { line, dashes, ring, gradient };
  Mark mark = Mark::line;
  Rgb color{0, 0, 0};
  double width = 2.0;  // [px] of the line
  std::string word;
};

/// Draws entries in rows, centred in at.x .. at.x + width, wrapped where they do not fit. Returns the height of all
/// rows; with page == nullptr it only measures.
double draw_legend(Page* page, const std::vector<LegendEntry>& entries, cv::Point2d at, double width, double font);

/// Draws the ring that marks the start of a path.
void draw_start_ring(Page& page, cv::Point2d center, double radius);

}  // namespace odosplat
