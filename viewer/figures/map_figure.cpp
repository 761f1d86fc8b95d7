// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/map_figure.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"

namespace odosplat {
namespace {

constexpr double view_elevation = 0.8;  // [rad]
const Rgb cameras_color(213, 94, 0);

struct MapLayout {
  cv::Size page;
  double font = 0.0;
  int title_height = 0;
  MapScenery scenery;
  FigureView view;  // of the page without the title
};

std::vector<Eigen::Vector3d> positions_of(const Trajectory& cameras) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& pose : cameras) {
    if (pose.T_world_camera.is_finite()) positions.push_back(pose.T_world_camera.translation());
  }
  return positions;
}

MapLayout lay_out(const MapFigure& figure) {
  require(figure.frusta >= 0, "frusta", "at least 0");
  MapLayout layout;
  layout.page = figure_size(figure.size, 0.75);
  layout.font = figure_font(layout.page);
  layout.title_height = figure.title.empty() ? 0 : static_cast<int>(std::lround(1.6 * layout.font));
  layout.scenery = prepare_map(figure.map, figure.cameras, figure.up, figure.cut_height);
  const cv::Size below(layout.page.width, layout.page.height - layout.title_height);
  if (figure.view) {
    layout.view = *figure.view;
    require(layout.view.size == below, "view size", "that of the page under the title");
  } else {
    const double azimuth = open_azimuth(layout.scenery);
    std::vector<Eigen::Vector3d> seen = facing_extent(layout.scenery, azimuth, view_elevation);
    const auto positions = positions_of(figure.cameras);
    seen.insert(seen.end(), positions.begin(), positions.end());
    layout.view = view_from_corner(layout.scenery.axes, seen, below, 0.03, azimuth, view_elevation);
  }
  return layout;
}

void add_frustum(FigureMesh& mesh, const Camera& camera, const SE3& T_world_camera, double depth, double radius) {
  const double right = camera.width - 0.5;
  const double low = camera.height - 0.5;
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {right, -0.5}, {right, low}, {-0.5, low}}) {
    corners.push_back(T_world_camera * Eigen::Vector3d(depth * camera.ray(u, v)));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.add_tube(T_world_camera.translation(), corners[i], radius, cameras_color, cameras_color);
    mesh.add_tube(corners[i], corners[(i + 1) % 4], radius, cameras_color, cameras_color);
    mesh.add_ball(corners[i], radius, cameras_color);
  }
}

/// Cameras at even steps, without those that would overlap another shown camera with a similar viewing direction.
std::vector<SE3> shown_cameras(const MapFigure& figure, double depth) {
  constexpr double clear = 1.5;     // distance within which frusta overlap [frustum depths]
  constexpr double same_way = 0.5;  // cosine of the angle between viewing directions
  std::vector<SE3> shown;
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(figure.frusta), figure.cameras.size());
  for (std::size_t k = 0; k < count; ++k) {
    const SE3& T = figure.cameras[k * figure.cameras.size() / count].T_world_camera;
    if (!T.is_finite()) continue;
    const Eigen::Vector3d way = T.rotation() * Eigen::Vector3d::UnitZ();
    const bool hidden = std::ranges::any_of(shown, [&](const SE3& other) {
      return (other.translation() - T.translation()).norm() < clear * depth &&
             way.dot(other.rotation() * Eigen::Vector3d::UnitZ()) > same_way;
    });
    if (!hidden) shown.push_back(T);
  }
  return shown;
}

}  // namespace

cv::Mat3b draw_map(const MapFigure& figure) {
  const MapLayout layout = lay_out(figure);
  const std::vector<Eigen::Vector3d> path = positions_of(figure.cameras);
  Eigen::Vector3d center = scenery_center(layout.scenery);
  if (layout.scenery.extent.empty() && !path.empty()) center = path[path.size() / 2];
  const double scale = layout.view.pixels_per_metre(center);
  std::vector<FigureLayer> layers;
  layers.push_back(map_layer(layout.scenery, layout.view, 0.0));
  if (!path.empty() && scale > 0.0) {
    const double pixel = 1.0 / scale;
    FigureLayer lines{FigureMesh(center)};
    lines.mesh.add_path(path, std::max(0.7, 0.0016 * layout.page.width) * pixel, {cameras_color});
    Camera camera = figure.camera;
    if (camera.width == 0) camera = {640, 480, 554.0, 554.0, 319.5, 239.5};
    camera.check();
    const double depth = figure.frustum_depth > 0.0 ? figure.frustum_depth : 0.05 * layout.page.width * pixel;
    for (const SE3& T_world_camera : shown_cameras(figure, depth)) {
      add_frustum(lines.mesh, camera, T_world_camera, depth, std::max(0.5, 0.0011 * layout.page.width) * pixel);
    }
    layers.push_back(std::move(lines));
  }

  Page page(layout.page);
  OffscreenWindow window;
  page.paste(window.render(layers, layout.view, Rgb(255, 255, 255)), {0, layout.title_height});
  const double font = layout.font;
  if (!path.empty()) {
    const auto start = layout.view.project(path.front());
    if (start) draw_start_ring(page, {start->x() + 0.5, start->y() + 0.5 + layout.title_height}, 0.3 * font);
  }
  if (!layout.scenery.extent.empty() || !path.empty()) {
    draw_scale_bar(page, scale, layout.page.width, {0.5 * font, layout.page.height - 0.5 * font}, AlignX::left, font);
    draw_axes(page, layout.view, {layout.page.width - 2.1 * font, layout.page.height - 2.1 * font}, 1.8 * font, font);
  }
  if (!figure.title.empty()) {
    const FittedText title = fit_text(figure.title, static_cast<int>(std::lround(font)), page.width() - font);
    page.text(title.text, {0.5 * page.width(), 0.5 * layout.title_height},
              {.size = static_cast<double>(title.size), .x = AlignX::center});
  }
  return page.pixels();
}

std::optional<Eigen::Vector2d> locate_in_map_figure(const MapFigure& figure, const Eigen::Vector3d& p_world) {
  const MapLayout layout = lay_out(figure);
  auto pixel = layout.view.project(p_world);
  if (pixel) pixel->y() += layout.title_height;
  return pixel;
}

}  // namespace odosplat
