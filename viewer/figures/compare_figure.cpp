// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/compare_figure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "odosplat/core/error.hpp"
#include "odosplat/eval/depth_metrics.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/figures/depth_figure.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"
#include "viewer/ticks.hpp"

namespace odosplat {
namespace {

bool is_depth(float v) { return v > 0.0F && std::isfinite(v); }

/// A copy of the image with 0 for all invalid depths.
DepthImage cleaned(const DepthImage& depth) {
  DepthImage result = depth.clone();
  for (float& v : result) v = is_depth(v) ? v : 0.0F;
  return result;
}

struct MethodError {
  cv::Mat1f image;      // [m], -1 = none
  DepthErrors figures;  // for the caption
};

MethodError method_error(const DepthImage& depth, const DepthImage& truth) {
  MethodError error{cv::Mat1f(truth.size(), -1.0F), {}};
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (is_depth(truth(y, x)) && is_depth(depth(y, x))) error.image(y, x) = std::abs(depth(y, x) - truth(y, x));
    }
  }
  DepthMetrics metrics;
  metrics.add(cleaned(depth), cleaned(truth));
  error.figures = metrics.result();
  return error;
}

/// The caption. All medians have the same unit, and all RMSE, so that they are easy to compare.
std::vector<std::string> caption(const DepthErrors& figures, const LengthUnit& median_unit,
                                 const LengthUnit& rmse_unit) {
  if (!(figures.valid_share > 0.0)) return {"no depth"};
  // Rounded down, so that 100 % means every pixel.
  const int percent = static_cast<int>(std::floor(100.0 * figures.valid_share + 1e-9));
  return {"median " + short_number(figures.median_abs_m * median_unit.factor) + " " + median_unit.name,
          "RMSE " + short_number(figures.rmse_m * rmse_unit.factor) + " " + rmse_unit.name,
          "valid " + std::to_string(percent) + " %"};
}

void check(const CompareFigure& figure) {
  require(!figure.examples.empty(), "examples", "one or more");
  require(figure.depth_max == 0.0 || figure.depth_max > figure.depth_min, "depth_max", "more than depth_min");
  require(figure.error_max >= 0.0 && std::isfinite(figure.error_max), "error_max", "at least 0");
  const auto& first = figure.examples.front();
  require(!first.methods.empty(), "methods", "one or more");
  for (const auto& example : figure.examples) {
    bool same = example.methods.size() == first.methods.size();
    for (std::size_t m = 0; same && m < first.methods.size(); ++m) {
      same = example.methods[m].name == first.methods[m].name;
    }
    require(same, "methods", "the same in every example");
    const cv::Size size = example.methods.front().depth.size();
    require(!size.empty(), "depth images", "not empty");
    for (const auto& method : example.methods) require(method.depth.size() == size, "depth images", "of one size");
    require(example.truth.empty() || example.truth.size() == size, "true depth", "as large as the methods' depth");
  }
}

/// Layout, in pixels.
struct Grid {
  double font = 0.0;
  double gap = 0.0;
  int columns = 0;
  cv::Size panel;
  double left = 0.0;
  double line_height(bool with_errors) const {
    const double below = with_errors ? panel.height + 3.8 * font : color_bar_height(font);
    return panel.height + 0.4 * font + below;
  }
  double height(std::size_t examples, bool with_errors) const {
    return 1.6 * font + static_cast<double>(examples) * (line_height(with_errors) + 0.8 * font);
  }
  double x(int column) const { return left + column * (panel.width + gap); }
};

}  // namespace

cv::Mat3b draw_compare(const CompareFigure& figure) {
  check(figure);
  const auto& first = figure.examples.front();
  const auto methods = first.methods.size();
  const bool with_truth = std::ranges::any_of(figure.examples, [](const auto& e) { return !e.truth.empty(); });
  const double shape = static_cast<double>(first.methods.front().depth.rows) / first.methods.front().depth.cols;

  ValueRange range{figure.depth_min, figure.depth_max};
  if (range.low == 0.0 && range.high == 0.0) {
    std::vector<const cv::Mat1f*> images;
    for (const auto& example : figure.examples) {
      if (!example.truth.empty()) images.push_back(&example.truth);
    }
    for (const auto& example : figure.examples) {
      for (const auto& method : example.methods) {
        if (!with_truth) images.push_back(&method.depth);
      }
    }
    range = depth_range_of(images);
  }
  std::vector<std::vector<MethodError>> errors;
  std::vector<float> all;
  for (const auto& example : figure.examples) {
    errors.emplace_back();
    for (const auto& method : example.methods) {
      if (example.truth.empty()) continue;
      errors.back().push_back(method_error(method.depth, example.truth));
      std::ranges::copy_if(errors.back().back().image, std::back_inserter(all), [](float v) { return v >= 0.0F; });
    }
  }
  double error_max = figure.error_max;
  if (!(error_max > 0.0) && !all.empty()) {
    const auto k = static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), all.begin() + k, all.end());
    error_max = nice_ceiling(std::max<double>(all[static_cast<std::size_t>(k)], 1e-4));
  }
  if (!(error_max > 0.0)) error_max = 1.0;

  const bool beyond = std::ranges::any_of(all, [&](float v) { return v > error_max; });

  Grid grid;
  grid.columns = static_cast<int>(methods) + (with_truth ? 2 : 1);
  const auto lay_out = [&](double panel_width) {
    // In a column 8.6 cm wide with four panels, 5 points are this share of a panel's width.
    grid.font = std::max(4.0, 0.088 * panel_width);
    grid.gap = 0.4 * grid.font;
    grid.panel = {std::max(4, static_cast<int>(panel_width)), std::max(4, static_cast<int>(panel_width * shape))};
  };
  const double by_width = figure.size.width / (grid.columns * (1.0 + 0.4 * 0.088) + 0.4 * 0.088);
  lay_out(by_width);
  const double natural = grid.height(figure.examples.size(), with_truth);
  Page page(figure_size(figure.size, natural / std::max(figure.size.width, 1)));
  if (natural > page.height() + 1.0) lay_out(by_width * page.height() / natural);
  grid.left = 0.5 * (page.width() - grid.columns * (grid.panel.width + grid.gap) + grid.gap);

  const double font = grid.font;
  const int size = static_cast<int>(std::lround(font));
  const int pitch = std::max(4, static_cast<int>(std::lround(0.3 * font)));
  const auto words = [&](const std::string& text, cv::Point2d at, double width) {
    const FittedText fitted = fit_text(text, size, width, 0.6);
    page.text(fitted.text, at, {.size = static_cast<double>(fitted.size), .x = AlignX::center});
  };
  const auto put = [&](const cv::Mat3b& picture, double x, double y) {
    const cv::Point at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
    page.paste(picture, at);
    page.frame(cv::Rect2d(cv::Rect(at, picture.size())), std::max(1.0, 0.04 * font), Rgb(90, 90, 90));
  };
  const auto depth_picture = [&](const DepthImage& depth) {
    return value_panel(depth, ColorScale::depth, range.low, range.high, grid.panel, pitch, false);
  };
  const int last = grid.columns - 1;
  const double panel_width = grid.panel.width;
  words("image", {grid.x(0) + 0.5 * panel_width, 0.85 * font}, panel_width);
  for (std::size_t m = 0; m < methods; ++m) {
    words(first.methods[m].name, {grid.x(static_cast<int>(m) + 1) + 0.5 * panel_width, 0.85 * font}, panel_width);
  }
  if (with_truth) words("truth", {grid.x(last) + 0.5 * panel_width, 0.85 * font}, panel_width);

  double y = 1.6 * font;
  const LengthUnit unit = length_unit(error_max);
  double largest_median = 0.0;
  double largest_rmse = 0.0;
  for (const auto& of_example : errors) {
    for (const auto& error : of_example) {
      largest_median = std::max(largest_median, error.figures.median_abs_m);
      largest_rmse = std::max(largest_rmse, error.figures.rmse_m);
    }
  }
  const LengthUnit median_unit = length_unit(largest_median);
  const LengthUnit rmse_unit = length_unit(largest_rmse);
  for (std::size_t e = 0; e < figure.examples.size(); ++e) {
    const CompareExample& example = figure.examples[e];
    put(color_panel(example.image, grid.panel), grid.x(0), y);
    for (std::size_t m = 0; m < methods; ++m) {
      put(depth_picture(example.methods[m].depth), grid.x(static_cast<int>(m) + 1), y);
    }
    if (!example.truth.empty()) put(depth_picture(example.truth), grid.x(last), y);
    const double below = y + grid.panel.height + 0.4 * font;
    const double inset = 0.4 * font;
    const ColorBar depth_bar{ColorScale::depth, range.low, range.high, "depth (m)", 0.0, 1.0, false, true};
    if (!with_truth) {
      draw_color_bar(page, depth_bar, {grid.x(0) + inset, below}, panel_width - 2.0 * inset, font, pitch);
    } else {
      for (std::size_t m = 0; m < errors[e].size(); ++m) {
        const double x = grid.x(static_cast<int>(m) + 1);
        put(value_panel(errors[e][m].image, ColorScale::error, 0.0, error_max, grid.panel, pitch, true), x, below);
        double line = below + grid.panel.height + 0.8 * font;
        for (const std::string& text : caption(errors[e][m].figures, median_unit, rmse_unit)) {
          words(text, {x + 0.5 * panel_width, line}, panel_width);
          line += 1.2 * font;
        }
      }
      // The colour bars of both scales are placed in the free cells below image and truth.
      double bar_y = below + 0.2 * font;
      if (!example.name.empty()) {
        words(example.name, {grid.x(0) + 0.5 * panel_width, bar_y + 0.5 * font}, panel_width);
      }
      bar_y += 2.0 * font;
      const ColorBar error_bar{
          ColorScale::error, 0.0, error_max * unit.factor, "error (" + unit.name + ")", 0.0, 1.0, beyond, false};
      draw_color_bar(page, depth_bar, {grid.x(0) + inset, bar_y}, panel_width - 2.0 * inset, font, pitch);
      draw_color_bar(page, error_bar, {grid.x(last) + inset, bar_y}, panel_width - 2.0 * inset, font, pitch);
    }
    y += grid.line_height(with_truth) + 0.8 * font;
  }
  return page.pixels();
}

}  // namespace odosplat
