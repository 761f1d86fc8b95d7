// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "viewer/color_map.hpp"

namespace odosplat {

enum class AlignX { left, center, right };
enum class AlignY { top, middle, bottom };

/// Font size and alignment of a line of text: size [px] is the font's em.
struct TextStyle {
  double size = 12.0;
  AlignX x = AlignX::left;
  AlignY y = AlignY::middle;
  Rgb color{0, 0, 0};
  bool vertical = false;  // turned by 90 degrees, read from below; x and y align the turned box
};

/// A white page of pixels on which figures are assembled. Coordinates are [px], x right, y down, (0,0) the corner of
/// the top-left pixel; everything outside is clipped. Lines are antialiased. Not thread safe.
class Page {
 public:
  explicit Page(cv::Size size) : pixels_(size, Rgb(255, 255, 255)) {}

  int width() const { return pixels_.cols; }
  int height() const { return pixels_.rows; }
  const cv::Mat3b& pixels() const { return pixels_; }

  /// Draws a line of text and returns its box (empty for blank text). `halo`: a white outline around the letters, for
  /// text over pictures.
  cv::Rect text(const std::string& text, cv::Point2d at, const TextStyle& style, bool halo = false);
  void line(cv::Point2d a, cv::Point2d b, double width, const Rgb& color);
  void polyline(const std::vector<cv::Point2d>& points, double width, const Rgb& color);
  /// Dashes and gaps of `period` / 2 [px] each.
  void dashed(const std::vector<cv::Point2d>& points, double width, const Rgb& color, double period);
  void fill(const cv::Rect2d& box, const Rgb& color);
  void frame(const cv::Rect2d& box, double width, const Rgb& color);
  void disc(cv::Point2d center, double radius, const Rgb& color);
  void hatch(const cv::Rect2d& box, int pitch);
  /// Copies the picture to the page, with its top-left corner at `at`.
  void paste(const cv::Mat3b& picture, cv::Point at);

 private:
  cv::Mat3b pixels_;
};

/// A colour image scaled to `size` in page pixels: by area means if it shrinks, otherwise linearly.
cv::Mat3b color_panel(const ColorImage& color, cv::Size size);

/// Values low..high in the colours of a scale, scaled to `size` by nearest pixels; hatched where the value is not > 0
/// (with zero_is_valid: not >= 0) or not finite.
cv::Mat3b value_panel(const cv::Mat1f& values, ColorScale scale, double low, double high, cv::Size size, int pitch,
                      bool zero_is_valid);

/// Arranges pictures on a white page, row by row in `columns` >= 1 columns, each column as wide and each row as high as
/// its largest picture. No pictures give an empty page.
cv::Mat3b tiled(const std::vector<cv::Mat3b>& pictures, int columns);

/// Size of a figure as requested; a height of 0 becomes width times `aspect`.
/// Throws InputError unless width is 16..16384 and height 0 or 16..16384.
cv::Size figure_size(cv::Size asked, double aspect);

/// Font size [px] that is at least 5 points if the figure is printed half a column (4.3 cm) wide.
double figure_font(cv::Size size);

}  // namespace odosplat
