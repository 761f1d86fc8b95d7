// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/error_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/upper_median.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"
#include "viewer/ticks.hpp"

namespace odosplat {
namespace {

struct Range {
  double low = std::numeric_limits<double>::max();
  double high = -std::numeric_limits<double>::max();
  void extend(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  bool empty() const { return low > high; }
};

double longest_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) steps.push_back(times[i + 1] - times[i]);
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  const double usual = upper_median(std::move(steps));
  return usual > 0.0 ? 2.5 * usual : std::numeric_limits<double>::infinity();
}

class Axes {
 public:
  Axes(const cv::Rect2d& box, Range x, Range y, bool log_y) : box_(box), x_(x), y_(y), log_y_(log_y) {}
  bool shows(double y) const { return std::isfinite(y) && (!log_y_ || y > 0.0); }
  double to_x(double x) const { return box_.x + (x - x_.low) / (x_.high - x_.low) * box_.width; }
  double to_y(double y) const {
    const double share = log_y_ ? std::log(y / y_.low) / std::log(y_.high / y_.low) : (y - y_.low) / (y_.high - y_.low);
    return box_.y + (1.0 - std::clamp(share, 0.0, 1.0)) * box_.height;
  }

 private:
  cv::Rect2d box_;
  Range x_;
  Range y_;
  bool log_y_;
};

std::vector<double> log_ticks(const Range& y) {
  std::vector<double> ticks;
  const bool many = std::log10(y.high / y.low) > 2.5;
  for (double power = std::pow(10.0, std::floor(std::log10(y.low) + 1e-9)); power <= y.high * 1.001; power *= 10.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * power;
      if (tick >= y.low * 0.999 && tick <= y.high * 1.001 && (factor == 1.0 || !many)) ticks.push_back(tick);
    }
  }
  return ticks;
}

/// The dash pattern follows the time axis, not the curve's length: on a noisy curve it would otherwise be too fine to
/// see.
void draw_dashes(Page& page, const std::vector<cv::Point2d>& points, double width, const Rgb& color, double dash) {
  std::vector<cv::Point2d> piece;
  const auto flush = [&]() {
    page.polyline(piece, width, color);
    piece.clear();
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const cv::Point2d a = points[i];
    const cv::Point2d b = points[i + 1];
    double x = a.x;
    while (x < b.x) {
      const double cell = std::floor(x / dash + 1e-9);
      const double next = std::min(b.x, (cell + 1.0) * dash);
      const auto at = [&](double u) { return a + (b - a) * ((u - a.x) / (b.x - a.x)); };
      if (std::fmod(cell, 3.0) < 2.0) {
        if (piece.empty()) piece.push_back(at(x));
        piece.push_back(at(next));
      } else {
        flush();
      }
      x = next;
    }
  }
  flush();
}

void draw_curve(Page& page, const Axes& axes, const ErrorSeries& series, double factor, double start_time,
                std::size_t index, double font) {
  const double longest = longest_step(series.times);
  const double width = std::max(1.0, 0.08 * font);
  std::vector<cv::Point2d> run;
  const auto flush = [&]() {
    if (run.size() == 1) page.disc(run[0], width, series_color(index));
    // Every second curve is dashed, so that curves can be told apart in greyscale prints.
    if (index % 2 == 0) {
      page.polyline(run, width, series_color(index));
    } else {
      draw_dashes(page, run, width, series_color(index), 0.25 * font);
    }
    run.clear();
  };
  for (std::size_t i = 0; i < series.times.size(); ++i) {
    const double value = series.errors[i] * factor;
    if (!axes.shows(value) || (i > 0 && series.times[i] - series.times[i - 1] > longest)) flush();
    if (axes.shows(value)) run.emplace_back(axes.to_x(series.times[i] - start_time), axes.to_y(value));
  }
  flush();
}

}  // namespace

cv::Mat3b draw_error_plot(const ErrorPlot& plot) {
  Range time;
  Range error;
  std::vector<double> positive;
  for (const auto& series : plot.series) {
    require(series.times.size() == series.errors.size(), "series " + series.name, "of as many times as errors");
    for (std::size_t i = 0; i < series.times.size(); ++i) {
      if (!std::isfinite(series.times[i])) continue;
      time.extend(series.times[i]);
      if (!std::isfinite(series.errors[i])) continue;
      error.extend(series.errors[i]);
      if (series.errors[i] > 0.0) positive.push_back(series.errors[i]);
    }
  }
  if (time.empty()) time = {0.0, 1.0};
  if (error.empty()) error = {0.0, 1.0};
  const double start_time = time.low;
  const LengthUnit unit = length_unit(error.high);
  const Range x{0.0, time.high > time.low ? time.high - time.low : 1.0};
  Range y{0.0, nice_ceiling(error.high * unit.factor * 1.02)};
  if (plot.log_scale) {
    // The lower end is the 1 % quantile: an error near zero, such as that of the first frame, would otherwise take up
    // half of the plot.
    const auto low_place = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 100);
    if (!positive.empty()) std::nth_element(positive.begin(), low_place, positive.end());
    const double low = (positive.empty() ? error.high : *low_place) * unit.factor;
    y.low = nice_floor(std::max(low, y.high * 1e-5));
    if (!(y.low < y.high)) y.low = y.high / 10.0;
  }

  Page page(figure_size(plot.size, 0.55));
  const double font = figure_font(page.pixels().size());
  const int size = static_cast<int>(std::lround(font));
  double top = 0.6 * font;
  if (!plot.title.empty()) {
    const FittedText title = fit_text(plot.title, size, page.width() - font);
    page.text(title.text, {0.5 * page.width(), 0.8 * font},
              {.size = static_cast<double>(title.size), .x = AlignX::center});
    top += 1.2 * font;
  }
  if (plot.series.size() > 1) {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      const auto mark = i % 2 == 0 ? LegendEntry::Mark::line : LegendEntry::Mark::dashes;
      entries.push_back({mark, series_color(i), std::max(1.0, 0.1 * font), plot.series[i].name});
    }
    top += draw_legend(&page, entries, {0.5 * font, top - 0.3 * font}, page.width() - font, font);
  }
  const double bottom = page.height() - 2.75 * font;
  const int y_count = std::clamp(static_cast<int>((bottom - top) / (1.8 * font)), 2, 7);
  const std::vector<double> y_ticks = plot.log_scale ? log_ticks(y) : nice_ticks(y.low, y.high, y_count);
  const auto y_text = [&](std::size_t i) {
    if (plot.log_scale) return short_number(y_ticks[i], 1);
    return tick_text(y_ticks[i], y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : y.high);
  };
  double tick_width = 0.0;
  for (std::size_t i = 0; i < y_ticks.size(); ++i) {
    tick_width = std::max<double>(tick_width, text_width(y_text(i), size));
  }
  const double left = 1.6 * font + tick_width + 0.4 * font;
  const cv::Rect2d box(left, top, std::max(page.width() - left - 0.8 * font, 4.0), std::max(bottom - top, 4.0));
  const Axes axes(box, x, y, plot.log_scale);
  const double thin = std::max(1.0, 0.04 * font);
  double last_label = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < y_ticks.size(); ++i) {
    const double at = axes.to_y(y_ticks[i]);
    page.fill({box.x, at - 0.5 * thin, box.width, thin}, Rgb(215, 215, 215));
    if (last_label - at < 1.05 * font) continue;
    page.text(y_text(i), {box.x - 0.3 * font, at}, {.size = font, .x = AlignX::right});
    last_label = at;
  }
  const double x_room = text_width(tick_text(x.high, 1.0) + ".5", size) + 1.2 * font;
  const std::vector<double> x_ticks = nice_ticks(x.low, x.high, std::clamp(static_cast<int>(box.width / x_room), 2, 9));
  for (const double tick : x_ticks) {
    const double at = axes.to_x(tick);
    const std::string text = tick_text(tick, x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : x.high);
    const double half = 0.5 * text_width(text, size);
    page.fill({at - 0.5 * thin, box.y, thin, box.height}, Rgb(215, 215, 215));
    page.text(text, {std::min(at, page.width() - half - 1.0), box.br().y + 0.3 * font},
              {.size = font, .x = AlignX::center, .y = AlignY::top});
  }
  page.frame(box, thin, Rgb(0, 0, 0));
  page.text("time (s)", {box.x + 0.5 * box.width, page.height() - 0.75 * font}, {.size = font, .x = AlignX::center});
  const FittedText y_words = fit_text(plot.words + " (" + unit.name + ")", size, box.height + 1.5 * font, 0.6);
  const double half = 0.5 * text_width(y_words.text, y_words.size);
  page.text(y_words.text, {0.8 * font, std::min(box.y + 0.5 * box.height, page.height() - half - 0.2 * font)},
            {.size = static_cast<double>(y_words.size), .x = AlignX::center, .vertical = true});
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    draw_curve(page, axes, plot.series[i], unit.factor, start_time, i, font);
  }
  return page.pixels();
}

}  // namespace odosplat
