// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/association_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "odosplat/core/error.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/figures/depth_figure.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"

namespace odosplat {
namespace {

// Upper end of the colour scale used: the colours beyond it are too pale for points on white.
constexpr double scale_end = 0.85;
constexpr double near_plane_m = 0.05;

struct SeenPoint {
  double u = 0.0;  // [px] of the camera's image
  double v = 0.0;
  double depth = 0.0;  // [m]
};

/// Visible points, far ones first, so that near ones are drawn over them.
std::vector<SeenPoint> seen_points(const AssociationFigure& figure) {
  std::vector<SeenPoint> seen;
  const SE3 T_camera_world = figure.T_world_camera.inverse();
  for (const Eigen::Vector3f& p_world : figure.cloud.points) {
    if (!p_world.allFinite()) continue;
    const Eigen::Vector3d p_camera = T_camera_world * p_world.cast<double>();
    if (p_camera.z() < near_plane_m) continue;
    const Eigen::Vector2d pixel = figure.camera.project(p_camera);
    const double x = std::floor(pixel.x() + 0.5);
    const double y = std::floor(pixel.y() + 0.5);
    if (!(x >= 0.0 && x < figure.camera.width && y >= 0.0 && y < figure.camera.height)) continue;
    const double surface = figure.rendered(static_cast<int>(y), static_cast<int>(x));
    if (surface > 0.0 && std::isfinite(surface) && p_camera.z() > 1.02 * surface + 0.03) continue;
    seen.push_back({pixel.x(), pixel.y(), p_camera.z()});
  }
  std::ranges::stable_sort(seen, std::greater<>(), &SeenPoint::depth);
  return seen;
}

cv::Mat3b points_panel(const AssociationFigure& figure, const ValueRange& range, cv::Size size) {
  Page panel(size);
  const std::vector<SeenPoint> seen = seen_points(figure);
  if (seen.empty()) return panel.pixels();
  const double sx = static_cast<double>(size.width) / figure.camera.width;
  const double sy = static_cast<double>(size.height) / figure.camera.height;
  // The diameter is half the mean distance of neighbours, so that the gaps between the points remain visible.
  const double spacing = std::sqrt(static_cast<double>(size.area()) / static_cast<double>(seen.size()));
  const double radius = std::clamp(0.25 * spacing, 0.8, 0.012 * size.width);
  for (const SeenPoint& point : seen) {
    const double t = (point.depth - range.low) / std::max(range.high - range.low, 1e-9);
    panel.disc({(point.u + 0.5) * sx, (point.v + 0.5) * sy}, radius,
               scale_color(ColorScale::depth, scale_end * std::clamp(t, 0.0, 1.0)));
  }
  return panel.pixels();
}

void check(const AssociationFigure& figure) {
  figure.camera.check();
  const cv::Size size(figure.camera.width, figure.camera.height);
  require(figure.interpolated.size() == size, "interpolated depth", "as large as the camera's image");
  require(figure.rendered.size() == size, "rendered depth", "as large as the camera's image");
  require(figure.image.empty() || figure.image.size() == size, "image", "as large as the camera's");
  const bool no_range = figure.depth_min == 0.0 && figure.depth_max == 0.0;
  require(no_range || figure.depth_max > figure.depth_min, "depth_max", "more than depth_min");
}

}  // namespace

cv::Mat3b draw_association(const AssociationFigure& figure) {
  check(figure);
  ValueRange range{figure.depth_min, figure.depth_max};
  if (range.low == 0.0 && range.high == 0.0) range = depth_range_of({&figure.interpolated, &figure.rendered});
  const double shape = static_cast<double>(figure.camera.height) / figure.camera.width;
  const double head = 1.4;  // font sizes over each panel
  const auto height_of = [&](double panel_height, double font) {
    return (figure.title.empty() ? 0.3 : 1.6) * font + 2.0 * (head * font + panel_height + 0.3 * font) + 0.3 * font +
           color_bar_height(font) + 0.3 * font;
  };
  const auto gap_of = [](double font) { return 0.6 * font; };
  const double natural_font = 0.042 * figure.size.width;
  const double natural = height_of(0.5 * (figure.size.width - 3.0 * gap_of(natural_font)) * shape, natural_font);
  Page page(figure_size(figure.size, natural / std::max(figure.size.width, 1)));
  double font = figure_font(page.pixels().size());
  const auto panel_width_for = [&](double letters) {
    return std::min(0.5 * (page.width() - 3.0 * gap_of(letters)),
                    0.5 * (page.height() - height_of(0.0, letters)) / shape);
  };
  // On a flat page the font is reduced before the pictures are, down to half its size.
  const double least_font = std::max(4.0, 0.5 * font);
  while (font > least_font && panel_width_for(font) < 0.3 * page.width()) font = std::max(least_font, 0.95 * font);
  const double gap = gap_of(font);
  const double width = std::max(8.0, std::floor(panel_width_for(font)));
  const cv::Size panel(static_cast<int>(width), std::max(4, static_cast<int>(width * shape)));
  const int size = static_cast<int>(std::lround(font));
  const int pitch = std::max(4, static_cast<int>(std::lround(0.3 * font)));
  const auto words = [&](const std::string& text, double x, double y, double room) {
    const FittedText fitted = fit_text(text, size, room, 0.6);
    page.text(fitted.text, {x, y}, {.size = static_cast<double>(fitted.size), .x = AlignX::center});
  };
  const auto put = [&](const std::string& name, const cv::Mat3b& picture, double x, double y) {
    words(name, x + 0.5 * width, y + 0.7 * font, width);
    const cv::Point at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y + head * font)));
    page.paste(picture, at);
    page.frame(cv::Rect2d(cv::Rect(at, picture.size())), std::max(1.0, 0.04 * font), Rgb(90, 90, 90));
  };
  const auto depth_picture = [&](const DepthImage& depth) {
    return value_panel(depth, ColorScale::depth, range.low, range.low + (range.high - range.low) / scale_end, panel,
                       pitch, false);
  };

  double y = 0.3 * font;
  if (!figure.title.empty()) {
    words(figure.title, 0.5 * page.width(), 0.9 * font, page.width() - 2.0 * gap);
    y = 1.6 * font;
  }
  const double left = 0.5 * (page.width() - 2.0 * width - gap);
  const double right = left + width + gap;
  put("interpolated depth", depth_picture(figure.interpolated), left, y);
  put("rendered depth", depth_picture(figure.rendered), right, y);
  y += head * font + panel.height + 0.3 * font;
  const cv::Mat3b points = points_panel(figure, range, panel);
  if (figure.image.empty()) {
    put("points of the map", points, 0.5 * (left + right), y);
  } else {
    put("points of the map", points, left, y);
    put("image", color_panel(figure.image, panel), right, y);
  }
  y += head * font + panel.height + 0.6 * font;
  const ColorBar bar{ColorScale::depth, range.low, range.high, "depth (m)", 0.0, scale_end, false, true};
  draw_color_bar(page, bar, {left, y}, 2.0 * width + gap, font, pitch);
  return page.pixels();
}

}  // namespace odosplat
