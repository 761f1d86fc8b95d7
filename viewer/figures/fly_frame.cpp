// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/fly_frame.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"

namespace odosplat {

cv::Mat3b draw_fly_frame(const FlyFrame& frame) {
  require(!frame.depth.empty(), "depth image", "not empty");
  require(frame.color.empty() || frame.color.size() == frame.depth.size(), "colour image", "as large as the depth");
  const cv::Size size = frame.depth.size();
  const double font = std::max(9.0, 0.045 * size.width);
  const int pitch = std::max(4, static_cast<int>(std::lround(0.3 * font)));
  const bool both = !frame.color.empty();
  const auto even = [](double v) { return 2 * static_cast<int>(std::ceil(0.5 * v)); };
  Page page({even(both ? 2.0 * size.width : size.width), even(size.height + 0.6 * font + color_bar_height(font))});
  const int right = both ? size.width : 0;
  if (both) page.paste(color_panel(frame.color, size), {0, 0});
  page.paste(value_panel(frame.depth, ColorScale::depth, frame.range.low, frame.range.high, size, pitch, false),
             {right, 0});
  const double below = size.height + 0.3 * font;
  const ColorBar bar{ColorScale::depth, frame.range.low, frame.range.high, "depth (m)", 0.0, 1.0, false, true};
  draw_color_bar(page, bar, {right + 0.5 * font, below}, size.width - font, font, pitch);
  if (both) {
    const FittedText words = fit_text(frame.words, static_cast<int>(std::lround(font)), size.width - font);
    page.text(words.text, {0.5 * font, below + 0.6 * font}, {.size = static_cast<double>(words.size)});
  }
  return page.pixels();
}

}  // namespace odosplat
