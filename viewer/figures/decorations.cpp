// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/decorations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/text.hpp"
#include "viewer/ticks.hpp"

namespace odosplat {
namespace {

constexpr double bar_share = 0.8;  // thickness of a colour bar / font size
constexpr double line_share = 1.15;

int font_pixels(double font) { return std::max(4, static_cast<int>(std::lround(font))); }

struct PlacedTick {
  double at = 0.0;     // [px] from the bar's left end
  double label = 0.0;  // [px] centre of its label, moved so that the label stays within the bar
  std::string text;
};

std::vector<PlacedTick> place_ticks(const ColorBar& bar, int count, double body, double width, int font) {
  const std::vector<double> ticks = nice_ticks(bar.low, bar.high, count);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : std::abs(bar.low);
  std::vector<PlacedTick> placed;
  for (const double tick : ticks) {
    PlacedTick place;
    place.text = tick_text(tick, step);
    place.at = (tick - bar.low) / std::max(bar.high - bar.low, 1e-12) * body;
    const double half = 0.5 * text_width(place.text, font);
    if (2.0 * half > width) continue;
    place.label = std::clamp(place.at, half, width - half);
    placed.push_back(place);
  }
  return placed;
}

/// As many round ticks as fit without overlapping labels.
std::vector<PlacedTick> fitting_ticks(const ColorBar& bar, double body, double width, int font) {
  for (int count = 6;; --count) {
    std::vector<PlacedTick> placed = place_ticks(bar, count, body, width, font);
    bool fits = true;
    for (std::size_t i = 0; i + 1 < placed.size(); ++i) {
      const double room = 0.5 * (text_width(placed[i].text, font) + text_width(placed[i + 1].text, font)) + 0.45 * font;
      fits = fits && placed[i + 1].label - placed[i].label >= room;
    }
    if (fits) return placed;
    if (count == 2) return {placed.front()};
  }
}

/// A round length in the unit with the fewest digits: "2 m", "50 cm", "2 mm".
std::string round_length_text(double metres) {
  if (metres >= 1000.0) return short_number(metres / 1000.0, 1) + " km";
  if (metres >= 1.0) return short_number(metres, 1) + " m";
  if (metres >= 0.01) return short_number(metres * 100.0, 1) + " cm";
  return short_number(metres * 1000.0, 1) + " mm";
}

}  // namespace

double color_bar_height(double font) { return color_bar_height_without_words(font) + line_share * font; }

double color_bar_height_without_words(double font) { return font * (bar_share + 0.2 + line_share); }

void draw_color_bar(Page& page, const ColorBar& bar, cv::Point2d at, double width, double font, int pitch) {
  const int size = font_pixels(font);
  const double thick = bar_share * font;
  const double tip = bar.more ? 0.6 * thick : 0.0;
  const double body = std::max(width - tip, 1.0);
  const int columns = static_cast<int>(std::floor(width));
  for (int x = 0; x < columns; ++x) {
    const double open = x + 0.5 > body ? std::max(0.0, 1.0 - (x + 0.5 - body) / tip) : 1.0;
    page.fill({std::round(at.x) + x, at.y + 0.5 * thick * (1.0 - open), 1.0, thick * open},
              scale_color(bar.scale, bar.start + (bar.end - bar.start) * std::min((x + 0.5) / body, 1.0)));
  }
  if (!bar.more) page.frame({at.x, at.y, static_cast<double>(columns), thick}, 0.05 * font, Rgb(0, 0, 0));

  for (const PlacedTick& tick : fitting_ticks(bar, body, width, size)) {
    const double x = at.x + std::clamp(tick.at, 0.03 * font, width - 0.03 * font);
    page.line({x, at.y + thick}, {x, at.y + 1.25 * thick}, 0.06 * font, Rgb(0, 0, 0));
    page.text(tick.text, {at.x + tick.label, at.y + thick + 0.2 * font},
              {.size = font, .x = AlignX::center, .y = AlignY::top});
  }
  if (bar.words.empty() && !bar.none) return;
  const double words_y = at.y + thick + (0.1 + 1.5 * line_share) * font;
  const std::string none = "none";
  const double swatch = 0.8 * font;
  const double none_width = bar.none ? swatch + 0.3 * font + text_width(none, size) : 0.0;
  const double free_width = width - (bar.none ? none_width + 0.6 * font : 0.0);
  const FittedText words = fit_text(bar.words, size, std::max(free_width, 0.0), 0.6);
  page.text(words.text, {bar.none ? at.x : at.x + 0.5 * width, words_y},
            {.size = static_cast<double>(words.size), .x = bar.none ? AlignX::left : AlignX::center});
  if (bar.none && none_width <= width) {
    const double x = at.x + width - none_width;
    page.hatch({x, words_y - 0.5 * swatch, swatch, swatch}, pitch);
    page.frame({x, words_y - 0.5 * swatch, swatch, swatch}, 0.05 * font, Rgb(90, 90, 90));
    page.text(none, {at.x + width, words_y}, {.size = font, .x = AlignX::right});
  }
}

void draw_scale_bar(Page& page, double pixels_per_metre, double view_width, cv::Point2d at, AlignX align, double font) {
  if (!(pixels_per_metre > 0.0) || !std::isfinite(pixels_per_metre)) return;
  const double metres = nice_floor(0.3 * view_width / pixels_per_metre);
  const double length = metres * pixels_per_metre;
  const double left = align == AlignX::right ? at.x - length : at.x;
  const double w = std::max(2.0, 0.14 * font);
  const double rim = std::max(1.0, 0.08 * font);
  page.fill({left - rim, at.y - w - rim, length + 2.0 * rim, w + 2.0 * rim}, Rgb(255, 255, 255));
  page.fill({left, at.y - w, length, w}, Rgb(0, 0, 0));
  const std::string text = round_length_text(metres);
  const double half = 0.5 * text_width(text, font_pixels(font));
  const double x =
      align == AlignX::right ? std::min(left + 0.5 * length, at.x - half) : std::max(left + 0.5 * length, left + half);
  page.text(text, {x, at.y - 1.2 * w}, {.size = font, .x = AlignX::center, .y = AlignY::bottom}, true);
}

void draw_axes(Page& page, const FigureView& view, cv::Point2d center, double radius, double font) {
  const Eigen::Matrix3d R_view_world = view.T_world_view.rotation_matrix().transpose();
  const std::array<const char*, 3> names{"x", "y", "z"};
  std::array<int, 3> order{0, 1, 2};
  // Drawn from back to front.
  std::ranges::sort(order, [&](int a, int b) { return R_view_world(2, a) > R_view_world(2, b); });
  for (const int axis : order) {
    const Eigen::Vector2d way = R_view_world.col(axis).head<2>();
    const double arm = radius - 0.6 * font;
    const cv::Point2d end(center.x + arm * way.x(), center.y + arm * way.y());
    page.line(center, end, 0.26 * font, Rgb(255, 255, 255));
    page.line(center, end, 0.1 * font, Rgb(0, 0, 0));
    if (way.norm() < 0.2) continue;  // parallel to the line of sight: its letter would overlap the others
    const Eigen::Vector2d at = (arm + 0.45 * font) * way.normalized() * std::min(1.0, way.norm() + 0.1);
    page.text(names[static_cast<std::size_t>(axis)], {center.x + at.x(), center.y + at.y()},
              {.size = 0.8 * font, .x = AlignX::center}, true);
  }
}

double draw_legend(Page* page, const std::vector<LegendEntry>& entries, cv::Point2d at, double width, double font) {
  const int size = font_pixels(font);
  const double sample = 1.5 * font;
  const double row_height = 1.4 * font;
  const double gap = 0.9 * font;
  double height = 0.0;
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    double used = 0.0;
    std::vector<FittedText> words;
    while (end < entries.size()) {
      const FittedText word = fit_text(entries[end].word, size, std::max(width - sample - 0.3 * font, 0.0));
      const double needed = sample + 0.3 * font + text_width(word.text, word.size) + (end > begin ? gap : 0.0);
      if (end > begin && used + needed > width) break;
      used += needed;
      words.push_back(word);
      ++end;
    }
    double x = at.x + 0.5 * std::max(width - used, 0.0);
    const double y = at.y + height + 0.5 * row_height;
    for (std::size_t i = begin; i < end && page != nullptr; ++i) {
      const LegendEntry& entry = entries[i];
      const cv::Point2d left(x, y);
      const cv::Point2d right(x + sample, y);
      switch (entry.mark) {
        case LegendEntry::Mark::line:
          page->line(left, right, entry.width, entry.color);
          break;
        case LegendEntry::Mark::dashes:
          page->dashed({left, right}, entry.width, entry.color, sample / 1.5);
          break;
        case LegendEntry::Mark::ring:
          draw_start_ring(*page, {x + 0.5 * sample, y}, entry.width);
          break;
        case LegendEntry::Mark::gradient:
          for (int c = 0; c < static_cast<int>(sample); ++c) {
            page->fill(
                {std::round(x) + c, y - 0.5 * entry.width, 1.0, entry.width},
                scale_color(ColorScale::error, path_scale_start + (path_scale_end - path_scale_start) * c / sample));
          }
          break;
      }
      const FittedText& word = words[i - begin];
      page->text(word.text, {x + sample + 0.3 * font, y}, {.size = static_cast<double>(word.size)});
      x += sample + 0.3 * font + text_width(word.text, word.size) + gap;
    }
    height += row_height;
    begin = end;
  }
  return height;
}

void draw_start_ring(Page& page, cv::Point2d center, double radius) {
  page.disc(center, radius, Rgb(0, 0, 0));
  page.disc(center, 0.62 * radius, Rgb(255, 255, 255));
}

}  // namespace odosplat
