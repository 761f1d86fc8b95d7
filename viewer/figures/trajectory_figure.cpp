// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/trajectory_figure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/eval/association.hpp"
#include "viewer/color_map.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"
#include "viewer/ticks.hpp"

namespace odosplat {
namespace {

const Rgb rim_color(70, 70, 70);
const Rgb unknown_color(0, 114, 178);

/// The paths that are drawn.
struct Paths {
  std::vector<std::vector<Eigen::Vector3d>> estimate;  // parts between lost frames
  std::vector<std::vector<Rgb>> colors;
  std::vector<std::vector<Eigen::Vector3d>> lost;
  std::vector<Eigen::Vector3d> truth;
};

double usual_step(const Trajectory& estimate) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < estimate.size(); ++i) steps.push_back(estimate[i + 1].time - estimate[i].time);
  return upper_median(std::move(steps));
}

Rgb path_color(double error, double error_max) {
  if (!std::isfinite(error)) return unknown_color;
  return scale_color(ColorScale::error,
                     path_scale_start + (path_scale_end - path_scale_start) * std::min(error / error_max, 1.0));
}

Paths make_paths(const TrajectoryFigure& figure, const std::vector<double>& errors, double error_max) {
  Paths paths;
  const double longest = longest_step(figure.estimate);
  double last_time = 0.0;
  for (std::size_t i = 0; i < figure.estimate.size(); ++i) {
    const auto& pose = figure.estimate[i];
    if (!pose.T_world_camera.is_finite()) continue;
    if (paths.estimate.empty() || pose.time - last_time > longest) {
      paths.estimate.emplace_back();
      paths.colors.emplace_back();
    }
    paths.estimate.back().push_back(pose.T_world_camera.translation());
    paths.colors.back().push_back(path_color(errors[i], error_max));
    last_time = pose.time;
  }
  for (const auto& pose : figure.truth) {
    if (pose.T_world_camera.is_finite()) paths.truth.push_back(pose.T_world_camera.translation());
  }
  paths.lost = lost_stretches(figure.estimate, figure.truth, figure.span);
  return paths;
}

/// End of the colour scale [m].
double find_error_max(const TrajectoryFigure& figure, const std::vector<double>& errors) {
  if (figure.error_max > 0.0) return figure.error_max;
  std::vector<double> known;
  std::ranges::copy_if(errors, std::back_inserter(known), [](double e) { return std::isfinite(e); });
  if (known.empty()) return 0.0;
  std::ranges::sort(known);
  const double high = known[static_cast<std::size_t>(0.99 * static_cast<double>(known.size() - 1))];
  return nice_ceiling(std::max(high, 1e-6));
}

/// Corners of the region to show: the path with enough of the map around it to recognise the place.
std::vector<Eigen::Vector3d> to_hold(const Paths& paths, const MapScenery& scenery) {
  Eigen::AlignedBox3d box;
  const auto in_axes = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.dot(scenery.axes.right), p.dot(scenery.axes.forward), p.dot(scenery.axes.up));
  };
  for (const auto& stretch : paths.estimate) {
    for (const auto& p : stretch) box.extend(in_axes(p));
  }
  for (const auto& p : paths.truth) box.extend(in_axes(p));
  if (box.isEmpty()) return scenery.extent;
  Eigen::AlignedBox3d room;
  for (const auto& p : scenery.extent) room.extend(in_axes(p));
  const auto widened = [&](double share) {
    const double reach = share * box.sizes().maxCoeff();
    const Eigen::Vector3d around(reach, reach, 0.3 * reach);
    return Eigen::AlignedBox3d(box.min() - around, box.max() + around);
  };
  const auto holds_some_map = [&](const Eigen::AlignedBox3d& part) {
    const auto held = std::ranges::count_if(scenery.extent, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d q = in_axes(p);
      return (q.head<2>().array() >= part.min().head<2>().array()).all() &&
             (q.head<2>().array() <= part.max().head<2>().array()).all();
    });
    return held * 8 >= static_cast<std::ptrdiff_t>(scenery.extent.size());
  };
  Eigen::AlignedBox3d wide = widened(0.25);
  for (double share = 0.3; share < 0.6 && !holds_some_map(wide); share += 0.05) wide = widened(share);
  if (!room.isEmpty()) wide = wide.intersection(room).merged(box);
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d c = wide.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    corners.emplace_back(c.x() * scenery.axes.right + c.y() * scenery.axes.forward + c.z() * scenery.axes.up);
  }
  return corners;
}

void draw_panel(Page& page, OffscreenWindow& window, const MapScenery& scenery, const Paths& paths,
                const FigureView& view, cv::Point corner, double font, const std::string& name) {
  Eigen::Vector3d center = scenery_center(scenery);
  if (!paths.truth.empty()) center = paths.truth[paths.truth.size() / 2];
  if (!paths.estimate.empty()) center = paths.estimate.front().front();
  const double scale = view.pixels_per_metre(center);
  const double pixel = scale > 0.0 ? 1.0 / scale : 0.0;
  const double band = std::max(1.2, 0.11 * font) * pixel;
  std::vector<FigureLayer> layers;
  layers.push_back(map_layer(scenery, view, 0.55));
  FigureLayer rim{FigureMesh(center)};
  FigureLayer colored{FigureMesh(center)};
  FigureLayer thin{FigureMesh(center)};
  for (std::size_t k = 0; k < paths.estimate.size(); ++k) {
    rim.mesh.add_path(paths.estimate[k], 1.2 * band, {rim_color});
    colored.mesh.add_path(paths.estimate[k], band, paths.colors[k]);
  }
  thin.mesh.add_path(paths.truth, 0.3 * band, {truth_color});
  for (const auto& stretch : paths.lost) {
    rim.mesh.add_path(stretch, 1.2 * band, {Rgb(255, 255, 255)});
    colored.mesh.add_dashed_path(stretch, band, lost_color, 3.0 * band);
  }
  layers.push_back(std::move(rim));
  layers.push_back(std::move(colored));
  layers.push_back(std::move(thin));
  page.paste(window.render(layers, view, Rgb(255, 255, 255)), corner);

  const std::vector<Eigen::Vector3d>& path =
      paths.truth.empty() && !paths.estimate.empty() ? paths.estimate.front() : paths.truth;
  if (!path.empty()) {
    const auto start = view.project(path.front());
    if (start) draw_start_ring(page, {start->x() + 0.5 + corner.x, start->y() + 0.5 + corner.y}, 0.28 * font);
  }
  const cv::Rect2d box(corner, cv::Size2d(view.size));
  page.frame(box, std::max(1.0, 0.04 * font), Rgb(120, 120, 120));
  const FittedText words = fit_text(name, static_cast<int>(std::lround(font)), box.width - 0.6 * font);
  page.text(words.text, {box.x + 0.35 * font, box.y + 0.2 * font},
            {.size = static_cast<double>(words.size), .y = AlignY::top}, true);
  if (!view.perspective && (!path.empty() || !scenery.extent.empty())) {
    draw_scale_bar(page, scale, view.size.width, {box.x + 0.5 * font, box.br().y - 0.4 * font}, AlignX::left, font);
  }
}

std::vector<LegendEntry> legend_of(const Paths& paths, double error_max, double font) {
  using Mark = LegendEntry::Mark;
  std::vector<LegendEntry> entries;
  const double band = std::max(2.0, 0.22 * font);
  if (!paths.truth.empty()) entries.push_back({Mark::line, truth_color, std::max(1.0, 0.07 * font), "truth"});
  if (!paths.estimate.empty()) {
    entries.push_back({error_max > 0.0 ? Mark::gradient : Mark::line, unknown_color, band, "estimate"});
  }
  if (!paths.lost.empty()) entries.push_back({Mark::dashes, lost_color, band, "lost"});
  if (!paths.truth.empty() || !paths.estimate.empty()) {
    entries.push_back({Mark::ring, truth_color, 0.28 * font, "start"});
  }
  return entries;
}

}  // namespace

double longest_step(const Trajectory& estimate) {
  const double step = usual_step(estimate);
  return step > 0.0 ? 2.5 * step : std::numeric_limits<double>::infinity();
}

std::vector<double> position_errors(const Trajectory& estimate, const Trajectory& truth, double tolerance) {
  std::vector<double> errors(estimate.size(), std::numeric_limits<double>::quiet_NaN());
  for (const Match& match : associate(estimate, truth, tolerance)) {
    errors[match.estimate] =
        (estimate[match.estimate].T_world_camera.translation() - truth[match.truth].T_world_camera.translation())
            .norm();
  }
  return errors;
}

std::vector<std::vector<Eigen::Vector3d>> lost_stretches(const Trajectory& estimate, const Trajectory& truth,
                                                         const std::optional<TimeSpan>& span) {
  std::vector<std::vector<Eigen::Vector3d>> stretches;
  if (estimate.empty()) return stretches;
  const double longest = longest_step(estimate);
  const auto add = [&](double from, double to, const StampedPose* first, const StampedPose* last) {
    std::vector<Eigen::Vector3d> path;
    for (const auto& pose : truth) {
      if (pose.time >= from && pose.time <= to && pose.T_world_camera.is_finite()) {
        path.push_back(pose.T_world_camera.translation());
      }
    }
    if (path.size() < 2 && first != nullptr && last != nullptr) {
      path = {first->T_world_camera.translation(), last->T_world_camera.translation()};
    }
    if (path.size() >= 2) stretches.push_back(std::move(path));
  };
  const double first = truth.empty() ? 0.0 : span ? std::max(span->first, truth.front().time) : truth.front().time;
  const double last = truth.empty() ? 0.0 : span ? std::min(span->last, truth.back().time) : truth.back().time;
  if (!truth.empty() && estimate.front().time - first > longest) add(first, estimate.front().time, nullptr, nullptr);
  for (std::size_t i = 0; i + 1 < estimate.size(); ++i) {
    const auto& a = estimate[i];
    const auto& b = estimate[i + 1];
    if (b.time - a.time > longest && a.T_world_camera.is_finite() && b.T_world_camera.is_finite()) {
      add(a.time, b.time, &a, &b);
    }
  }
  if (!truth.empty() && last - estimate.back().time > longest) add(estimate.back().time, last, nullptr, nullptr);
  return stretches;
}

cv::Mat3b draw_trajectory(const TrajectoryFigure& figure) {
  require(figure.errors.empty() || figure.errors.size() == figure.estimate.size(), "errors",
          "as many as the estimated poses");
  require(std::isfinite(figure.error_max) && figure.error_max >= 0.0, "error_max", "at least 0");
  Page page(figure_size(figure.size, 0.75));
  const double font = figure_font(page.pixels().size());
  const std::vector<double> errors =
      figure.errors.empty() ? position_errors(figure.estimate, figure.truth) : figure.errors;
  const double error_max = find_error_max(figure, errors);
  const Paths paths = make_paths(figure, errors, error_max);
  const MapScenery scenery =
      prepare_map(figure.map, figure.truth.empty() ? figure.estimate : figure.truth, figure.up, figure.cut_height);

  const double gap = 0.4 * font;
  const double width = page.width() - 2.0 * gap;
  const std::vector<LegendEntry> entries = legend_of(paths, error_max, font);
  const double legend_height = draw_legend(nullptr, entries, {}, width, font);
  const double bar_height = error_max > 0.0 ? color_bar_height_without_words(font) + 0.2 * font : 0.0;
  double top = gap;
  if (!figure.title.empty()) {
    const FittedText title = fit_text(figure.title, static_cast<int>(std::lround(font)), width);
    page.text(title.text, {0.5 * page.width(), 0.8 * font},
              {.size = static_cast<double>(title.size), .x = AlignX::center});
    top = 1.6 * font;
  }
  const double bottom = page.height() - gap - legend_height - bar_height;
  const bool beside = width >= bottom - top;
  const cv::Size panel(std::max(8, static_cast<int>(beside ? (width - gap) / 2.0 : width)),
                       std::max(8, static_cast<int>(beside ? bottom - top : (bottom - top - gap) / 2.0)));
  const cv::Point first(static_cast<int>(std::lround(gap)), static_cast<int>(std::lround(top)));
  const int step = static_cast<int>(std::lround(gap));
  const cv::Point second = first + (beside ? cv::Point(panel.width + step, 0) : cv::Point(0, panel.height + step));

  const std::vector<Eigen::Vector3d> seen = to_hold(paths, scenery);
  OffscreenWindow window;
  draw_panel(page, window, scenery, paths, view_from_above(scenery.axes, seen, panel, 0.02), first, font, "from above");
  draw_panel(page, window, scenery, paths,
             view_from_corner(scenery.axes, seen, panel, 0.02, open_azimuth(scenery), 0.7), second, font,
             "perspective");
  draw_legend(&page, entries, {gap, bottom}, width, font);
  if (error_max > 0.0) {
    const LengthUnit unit = length_unit(error_max);
    ColorBar bar;
    bar.scale = ColorScale::error;
    bar.high = error_max * unit.factor;
    bar.start = path_scale_start;
    bar.end = path_scale_end;
    bar.more = std::ranges::any_of(errors, [&](double e) { return e > error_max; });
    const FittedText words = fit_text("error (" + unit.name + ")", static_cast<int>(std::lround(font)), 0.4 * width);
    const double y = bottom + legend_height + 0.15 * font;
    page.text(words.text, {gap, y + 0.4 * font}, {.size = static_cast<double>(words.size)});
    const double left = gap + text_width(words.text, words.size) + 0.7 * font;
    draw_color_bar(page, bar, {left, y}, std::max(page.width() - 1.2 * gap - left, 1.0), font, 4);
  }
  return page.pixels();
}

}  // namespace odosplat
