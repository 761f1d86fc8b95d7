// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/page.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"
#include "viewer/text.hpp"

namespace odosplat {
namespace {

constexpr int shift = 4;  // fractional bits of coordinates in OpenCV's drawing functions

cv::Scalar scalar(const Rgb& color) { return {double(color[0]), double(color[1]), double(color[2])}; }

// OpenCV's (0,0) is the centre of the first pixel. Coordinates are clamped, as OpenCV's fixed-point numbers would
// overflow.
cv::Point fixed_point(cv::Point2d p) {
  const auto coordinate = [](double v) {
    return static_cast<int>(std::lround((std::clamp(v, -1e5, 1e5) - 0.5) * (1 << shift)));
  };
  return {coordinate(p.x), coordinate(p.y)};
}

cv::Rect pixel_box(const cv::Rect2d& box, cv::Size page) {
  const int x0 = static_cast<int>(std::lround(box.x));
  const int y0 = static_cast<int>(std::lround(box.y));
  const int x1 = static_cast<int>(std::lround(box.x + box.width));
  const int y1 = static_cast<int>(std::lround(box.y + box.height));
  return cv::Rect(x0, y0, std::max(x1 - x0, 0), std::max(y1 - y0, 0)) & cv::Rect({0, 0}, page);
}

void blend(cv::Vec3b& pixel, const Rgb& color, int ink) {
  for (int c = 0; c < 3; ++c) {
    pixel[c] = static_cast<unsigned char>((pixel[c] * (255 - ink) + color[c] * ink + 127) / 255);
  }
}

void blend_ink(cv::Mat3b& pixels, const cv::Mat1b& ink, cv::Point at, const Rgb& color) {
  for (int y = 0; y < ink.rows; ++y) {
    for (int x = 0; x < ink.cols; ++x) {
      const cv::Point p = at + cv::Point(x, y);
      if (ink(y, x) != 0 && p.x >= 0 && p.y >= 0 && p.x < pixels.cols && p.y < pixels.rows) {
        blend(pixels(p), color, ink(y, x));
      }
    }
  }
}

}  // namespace

cv::Rect Page::text(const std::string& text, cv::Point2d at, const TextStyle& style, bool halo) {
  const int size = std::max(4, static_cast<int>(std::lround(style.size)));
  cv::Mat1b ink = text_ink(text, size);
  if (ink.empty()) return {};
  // The visual middle of a line of text is that of its capitals, which is above the middle of the box with the
  // descenders.
  double drop = style.y == AlignY::middle ? 0.11 * size : 0.0;
  double slide = 0.0;
  if (style.vertical) {
    cv::rotate(ink, ink, cv::ROTATE_90_COUNTERCLOCKWISE);
    slide = style.x == AlignX::center ? 0.11 * size : 0.0;
    drop = 0.0;
  }
  const double x_share = style.x == AlignX::left ? 0.0 : style.x == AlignX::center ? 0.5 : 1.0;
  const double y_share = style.y == AlignY::top ? 0.0 : style.y == AlignY::middle ? 0.5 : 1.0;
  const cv::Point corner(static_cast<int>(std::lround(at.x + slide - x_share * ink.cols)),
                         static_cast<int>(std::lround(at.y + drop - y_share * ink.rows)));
  if (halo) {
    const int rim = std::max(1, size / 8);
    cv::Mat1b wide;
    cv::copyMakeBorder(ink, wide, rim, rim, rim, rim, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::dilate(wide, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rim + 1, 2 * rim + 1}));
    blend_ink(pixels_, wide, corner - cv::Point(rim, rim), Rgb(255, 255, 255));
  }
  blend_ink(pixels_, ink, corner, style.color);
  return {corner, ink.size()};
}

void Page::line(cv::Point2d a, cv::Point2d b, double width, const Rgb& color) { polyline({a, b}, width, color); }

void Page::polyline(const std::vector<cv::Point2d>& points, double width, const Rgb& color) {
  const int thickness = std::max(1, static_cast<int>(std::lround(width)));
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    cv::line(pixels_, fixed_point(points[i]), fixed_point(points[i + 1]), scalar(color), thickness, cv::LINE_AA, shift);
  }
}

void Page::dashed(const std::vector<cv::Point2d>& points, double width, const Rgb& color, double period) {
  const double half = std::max(period / 2.0, 1.0);
  double walked = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const cv::Point2d step = points[i + 1] - points[i];
    const double length = std::hypot(step.x, step.y);
    if (!(length > 0.0) || length > 1e6) continue;
    double begin = 0.0;
    while (begin < length) {
      const double phase = std::fmod(walked + begin, 2.0 * half);
      const bool inked = phase < half;
      const double end = std::min(length, begin + (inked ? half - phase : 2.0 * half - phase) + 1e-6);
      if (inked) line(points[i] + step * (begin / length), points[i] + step * (end / length), width, color);
      begin = end;
    }
    walked += length;
  }
}

void Page::fill(const cv::Rect2d& box, const Rgb& color) { pixels_(pixel_box(box, pixels_.size())).setTo(color); }

void Page::frame(const cv::Rect2d& box, double width, const Rgb& color) {
  const double w = std::max(1.0, std::round(width));
  fill({box.x, box.y, box.width, w}, color);
  fill({box.x, box.y + box.height - w, box.width, w}, color);
  fill({box.x, box.y, w, box.height}, color);
  fill({box.x + box.width - w, box.y, w, box.height}, color);
}

void Page::disc(cv::Point2d center, double radius, const Rgb& color) {
  cv::circle(pixels_, fixed_point(center), static_cast<int>(std::lround(radius * (1 << shift))), scalar(color),
             cv::FILLED, cv::LINE_AA, shift);
}

void Page::hatch(const cv::Rect2d& box, int pitch) {
  const cv::Rect pixels = pixel_box(box, pixels_.size());
  for (int y = pixels.y; y < pixels.br().y; ++y) {
    for (int x = pixels.x; x < pixels.br().x; ++x) pixels_(y, x) = hatch_color(x - pixels.x, y - pixels.y, pitch);
  }
}

void Page::paste(const cv::Mat3b& picture, cv::Point at) {
  const cv::Rect place = cv::Rect(at, picture.size()) & cv::Rect({0, 0}, pixels_.size());
  if (place.empty()) return;
  picture(cv::Rect(place.tl() - at, place.size())).copyTo(pixels_(place));
}

cv::Mat3b color_panel(const ColorImage& color, cv::Size size) {
  if (color.empty()) return {size, Rgb(255, 255, 255)};
  cv::Mat3b bytes(color.size());
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float v = color(y, x)[c];
        bytes(y, x)[c] = static_cast<unsigned char>(std::lround(255.0F * (v > 0.0F ? std::min(v, 1.0F) : 0.0F)));
      }
    }
  }
  cv::Mat3b panel;
  cv::resize(bytes, panel, size, 0.0, 0.0, size.width < color.cols ? cv::INTER_AREA : cv::INTER_LINEAR);
  return panel;
}

cv::Mat3b value_panel(const cv::Mat1f& values, ColorScale scale, double low, double high, cv::Size size, int pitch,
                      bool zero_is_valid) {
  cv::Mat3b panel(size);
  const double range = high > low ? high - low : 1.0;
  for (int y = 0; y < size.height; ++y) {
    const int v = std::min(values.rows - 1, static_cast<int>((y + 0.5) * values.rows / size.height));
    for (int x = 0; x < size.width; ++x) {
      const int u = std::min(values.cols - 1, static_cast<int>((x + 0.5) * values.cols / size.width));
      const float value = values.empty() ? -1.0F : values(v, u);
      const bool valid = std::isfinite(value) && (zero_is_valid ? value >= 0.0F : value > 0.0F);
      panel(y, x) = valid ? scale_color(scale, (value - low) / range) : hatch_color(x, y, pitch);
    }
  }
  return panel;
}

cv::Mat3b tiled(const std::vector<cv::Mat3b>& pictures, int columns) {
  require(columns >= 1, "columns", "1 or more");
  if (pictures.empty()) return {};
  const auto count = static_cast<int>(pictures.size());
  std::vector<int> widths(static_cast<std::size_t>(std::min(columns, count)), 0);
  std::vector<int> heights(static_cast<std::size_t>((count + columns - 1) / columns), 0);
  for (int k = 0; k < count; ++k) {
    const cv::Mat3b& picture = pictures[static_cast<std::size_t>(k)];
    int& width = widths[static_cast<std::size_t>(k % columns)];
    int& height = heights[static_cast<std::size_t>(k / columns)];
    width = std::max(width, picture.cols);
    height = std::max(height, picture.rows);
  }
  Page page({std::accumulate(widths.begin(), widths.end(), 0), std::accumulate(heights.begin(), heights.end(), 0)});
  for (int k = 0; k < count; ++k) {
    page.paste(pictures[static_cast<std::size_t>(k)],
               {std::accumulate(widths.begin(), widths.begin() + k % columns, 0),
                std::accumulate(heights.begin(), heights.begin() + k / columns, 0)});
  }
  return page.pixels();
}

cv::Size figure_size(cv::Size asked, double aspect) {
  require(asked.width >= 16 && asked.width <= 16384, "figure width", "16 to 16384 pixels");
  require(asked.height == 0 || (asked.height >= 16 && asked.height <= 16384), "figure height",
          "16 to 16384 pixels, or 0 for what suits the width");
  if (asked.height > 0) return asked;
  return {asked.width, std::clamp(static_cast<int>(std::lround(asked.width * aspect)), 16, 16384)};
}

double figure_font(cv::Size size) {
  // 5 points are 1.76 mm, which is 4.1 % of 43 mm. The second limit keeps the letters small on a flat figure.
  return std::max(4.0, std::min(0.042 * size.width, 0.08 * size.height));
}

}  // namespace odosplat
