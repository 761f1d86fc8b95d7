// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/depth_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <vector>

#include "odosplat/core/error.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"
#include "viewer/ticks.hpp"

namespace odosplat {
namespace {

struct Panel {
  std::string name;
  std::function<cv::Mat3b(cv::Size size, int pitch)> picture;
  bool has_bar = false;
  ColorBar bar;
};

/// 95th percentile of the valid values: single values at the map's border can be many times larger than the rest.
double most_of(const cv::Mat1f& image) {
  std::vector<float> values;
  std::ranges::copy_if(image, std::back_inserter(values), [](float v) { return v > 0.0F && std::isfinite(v); });
  if (values.empty()) return 1.0;
  const auto k = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), k, values.end());
  return *k;
}

std::vector<Panel> make_panels(const DepthFigure& figure) {
  std::vector<Panel> panels;
  if (!figure.color.empty()) {
    panels.push_back({"image", [&](cv::Size size, int) { return color_panel(figure.color, size); }, false, {}});
  }
  ValueRange range{figure.depth_min, figure.depth_max};
  if (range.low == 0.0 && range.high == 0.0) range = depth_range_of({&figure.depth});
  panels.push_back({"depth",
                    [&figure, range](cv::Size size, int pitch) {
                      return value_panel(figure.depth, ColorScale::depth, range.low, range.high, size, pitch, false);
                    },
                    true,
                    {ColorScale::depth, range.low, range.high, "depth (m)", 0.0, 1.0, false, true}});
  if (!figure.sigma.empty()) {
    const double high = figure.sigma_max > 0.0 ? figure.sigma_max : nice_ceiling(most_of(figure.sigma));
    const LengthUnit unit = length_unit(high);
    const bool beyond = std::ranges::any_of(figure.sigma, [&](float v) { return std::isfinite(v) && v > high; });
    panels.push_back(
        {"sigma",
         [&figure, high](cv::Size size, int pitch) {
           return value_panel(figure.sigma, ColorScale::error, 0.0, high, size, pitch, false);
         },
         true,
         {ColorScale::error, 0.0, high * unit.factor, "sigma (" + unit.name + ")", 0.0, 1.0, beyond, false}});
  }
  if (!figure.alpha.empty()) {
    panels.push_back({"alpha",
                      [&figure](cv::Size size, int pitch) {
                        return value_panel(figure.alpha, ColorScale::depth, 0.0, 1.0, size, pitch, true);
                      },
                      true,
                      {ColorScale::depth, 0.0, 1.0, "alpha", 0.0, 1.0, false, false}});
  }
  return panels;
}

void check(const DepthFigure& figure) {
  const auto same = [&](cv::Size size) { return size.empty() || size == figure.depth.size(); };
  require(same(figure.color.size()), "colour image", "as large as the depth image");
  require(same(figure.sigma.size()), "sigma image", "as large as the depth image");
  require(same(figure.alpha.size()), "alpha image", "as large as the depth image");
  const bool no_range = figure.depth_min == 0.0 && figure.depth_max == 0.0;
  require(no_range || figure.depth_max > figure.depth_min, "depth_max", "more than depth_min");
  require(figure.sigma_max >= 0.0 && std::isfinite(figure.sigma_max), "sigma_max", "at least 0");
}

}  // namespace

ValueRange depth_range_of(const std::vector<const cv::Mat1f*>& images) {
  std::vector<float> values;
  for (const auto* image : images) {
    for (int y = 0; y < image->rows; ++y) {
      for (int x = 0; x < image->cols; ++x) {
        const float v = (*image)(y, x);
        if (v > 0.0F && std::isfinite(v)) values.push_back(v);
      }
    }
  }
  if (values.empty()) return {};
  const auto quantile = [&](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(k)]);
  };
  const double low = quantile(0.005);
  const double high = quantile(0.995);
  const double slack = std::max(0.01 * (high - low), 1e-3 * high);
  return {std::max(low - slack, 0.0), high + slack};
}

cv::Mat3b draw_depth(const DepthFigure& figure) {
  check(figure);
  const std::vector<Panel> panels = make_panels(figure);
  const int columns = panels.size() > 1 ? 2 : 1;
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const double shape = figure.depth.empty() ? 0.75 : static_cast<double>(figure.depth.rows) / figure.depth.cols;

  // Lengths are multiples of the font size here, because the page's height may depend on them.
  const auto layout_height = [&](double panel_height, double font) {
    double height = 0.4 * font + (figure.title.empty() ? 0.0 : 1.5 * font);
    for (int row = 0; row < rows; ++row) {
      bool bar = false;
      for (int c = 0; c < columns; ++c) {
        const auto k = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c);
        bar = bar || (k < panels.size() && panels[k].has_bar);
      }
      height += 1.3 * font + panel_height + (bar ? 0.3 * font + color_bar_height(font) : 0.0) + 0.3 * font;
    }
    return height;
  };
  const double natural_font = 0.042 * figure.size.width;
  const double natural_panel = (figure.size.width - (columns + 1) * 0.6 * natural_font) / columns;
  const double natural = layout_height(natural_panel * shape, natural_font);
  Page page(figure_size(figure.size, natural / std::max(figure.size.width, 1)));
  double font = figure_font(page.pixels().size());
  const auto fitting_width = [&]() {
    const double free_height = page.height() - layout_height(0.0, font);
    return std::min((page.width() - (columns + 1) * 0.6 * font) / columns, free_height / rows / shape);
  };
  // On a page flatter than the panels need, the font is reduced before the pictures are, down to half its size.
  const double least_font = std::max(4.0, 0.5 * font);
  while (font > least_font && fitting_width() < 0.6 * page.width() / columns) font = std::max(least_font, 0.95 * font);
  const double gap = 0.6 * font;
  const double panel_width = std::max(8.0, fitting_width());
  const cv::Size panel(static_cast<int>(panel_width), std::max(4, static_cast<int>(panel_width * shape)));
  const int pitch = std::max(4, static_cast<int>(std::lround(0.3 * font)));
  const int size = static_cast<int>(std::lround(font));

  double y = 0.4 * font;
  if (!figure.title.empty()) {
    const FittedText title = fit_text(figure.title, size, page.width() - 2.0 * gap);
    page.text(title.text, {0.5 * page.width(), y + 0.5 * font},
              {.size = static_cast<double>(title.size), .x = AlignX::center});
    y += 1.5 * font;
  }
  const double column_step = panel_width + gap;
  const double left = 0.5 * (page.width() - columns * column_step + gap);
  for (int row = 0; row < rows; ++row) {
    bool bar = false;
    for (int c = 0; c < columns; ++c) {
      const auto k = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c);
      if (k >= panels.size()) break;
      const Panel& part = panels[k];
      const cv::Point2d corner(left + c * column_step, y + 1.3 * font);
      const FittedText name = fit_text(part.name, size, panel_width);
      page.text(name.text, {corner.x + 0.5 * panel_width, y + 0.65 * font},
                {.size = static_cast<double>(name.size), .x = AlignX::center});
      const cv::Point at(static_cast<int>(std::lround(corner.x)), static_cast<int>(std::lround(corner.y)));
      page.paste(part.picture(panel, pitch), at);
      page.frame(cv::Rect2d(cv::Rect(at, panel)), std::max(1.0, 0.04 * font), Rgb(90, 90, 90));
      if (part.has_bar) {
        draw_color_bar(page, part.bar, {corner.x, corner.y + panel.height + 0.3 * font}, panel_width, font, pitch);
        bar = true;
      }
    }
    y += 1.3 * font + panel.height + (bar ? 0.3 * font + color_bar_height(font) : 0.0) + 0.3 * font;
  }
  return page.pixels();
}

}  // namespace odosplat
