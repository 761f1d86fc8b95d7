// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/trajectories_figure.hpp"

#include <algorithm>
#include <cmath>

#include "viewer/color_map.hpp"
#include "viewer/figure_view.hpp"
#include "viewer/figures/decorations.hpp"
#include "viewer/figures/trajectory_figure.hpp"
#include "viewer/page.hpp"
#include "viewer/text.hpp"

namespace odosplat {
namespace {

// Light enough that the black line over it is visible in greyscale, dark enough for a white background.
const Rgb estimate_color(230, 159, 0);

using Path = std::vector<Eigen::Vector3d>;

Path positions(const Trajectory& trajectory) {
  Path path;
  for (const StampedPose& pose : trajectory) {
    if (pose.T_world_camera.is_finite()) path.push_back(pose.T_world_camera.translation());
  }
  return path;
}

/// The estimate, divided at lost frames.
std::vector<Path> unbroken(const Trajectory& estimate) {
  std::vector<Path> stretches;
  const double longest = longest_step(estimate);
  double last_time = 0.0;
  for (const StampedPose& pose : estimate) {
    if (!pose.T_world_camera.is_finite()) continue;
    if (stretches.empty() || pose.time - last_time > longest) stretches.emplace_back();
    stretches.back().push_back(pose.T_world_camera.translation());
    last_time = pose.time;
  }
  return stretches;
}

void draw_panel(Page& page, const TrajectoryPanel& panel, const cv::Rect& box, double font) {
  const Trajectory& cameras = panel.truth.empty() ? panel.estimate : panel.truth;
  Path all = positions(panel.truth);
  const Path estimated = positions(panel.estimate);
  all.insert(all.end(), estimated.begin(), estimated.end());
  page.frame(cv::Rect2d(box), std::max(1.0, 0.04 * font), Rgb(120, 120, 120));
  if (all.empty()) return;
  std::vector<Eigen::Vector3f> points;
  for (const auto& p : all) points.push_back(p.cast<float>());
  const Eigen::Vector3d up = panel.up.norm() > 0.0 ? panel.up : estimate_up(cameras);
  // A strip below the paths is reserved for the scale bar.
  const int strip = static_cast<int>(std::lround(1.9 * font));
  const cv::Size free(box.width, std::max(4, box.height - strip));
  const FigureView view = view_from_above(plan_axes(up, points, {}), all, free, 0.06);
  const auto on_page = [&](const Path& path) {
    std::vector<cv::Point2d> pixels;
    for (const auto& p : path) {
      if (const auto pixel = view.project(p)) pixels.emplace_back(pixel->x() + 0.5 + box.x, pixel->y() + 0.5 + box.y);
    }
    return pixels;
  };
  const double band = std::max(2.0, 0.26 * font);
  const double thin = std::max(1.0, 0.055 * font);
  for (const Path& stretch : unbroken(panel.estimate)) {
    const auto pixels = on_page(stretch);
    page.polyline(pixels, band, estimate_color);
    if (pixels.size() == 1) page.disc(pixels.front(), 0.5 * band, estimate_color);
  }
  for (const Path& stretch : lost_stretches(panel.estimate, panel.truth)) {
    page.dashed(on_page(stretch), 0.7 * band, lost_color, 0.9 * font);
  }
  const auto true_path = on_page(positions(panel.truth));
  page.polyline(true_path, thin, truth_color);
  const auto start = true_path.empty() ? on_page(estimated) : true_path;
  draw_start_ring(page, start.front(), 0.28 * font);
  draw_scale_bar(page, view.pixels_per_metre(all.front()), box.width, {box.x + 0.5 * font, box.br().y - 0.4 * font},
                 AlignX::left, font);
}

}  // namespace

cv::Mat3b draw_trajectories(const TrajectoriesFigure& figure) {
  const int count = static_cast<int>(figure.panels.size());
  const int columns = std::clamp(count, 1, 2);
  const int rows = std::max(1, (count + columns - 1) / columns);
  const double natural_font = 0.042 * figure.size.width;
  const double natural_panel = 0.8 * figure.size.width / columns;
  const double natural = rows * (natural_panel + 1.8 * natural_font) + 1.7 * natural_font;
  Page page(figure_size(figure.size, natural / std::max(figure.size.width, 1)));
  if (count == 0) return page.pixels();
  const double font = std::min(figure_font(page.pixels().size()), 0.08 * page.height() / rows);
  const int size = static_cast<int>(std::lround(font));
  const double gap = 0.5 * font;

  const auto any = [&](auto&& holds) { return std::ranges::any_of(figure.panels, holds); };
  using Mark = LegendEntry::Mark;
  std::vector<LegendEntry> entries;
  if (any([](const TrajectoryPanel& p) { return !p.truth.empty(); })) {
    entries.push_back({Mark::line, truth_color, std::max(1.0, 0.07 * font), "truth"});
  }
  if (any([](const TrajectoryPanel& p) { return !p.estimate.empty(); })) {
    entries.push_back({Mark::line, estimate_color, std::max(2.0, 0.26 * font), "estimate"});
  }
  if (any([](const TrajectoryPanel& p) { return !lost_stretches(p.estimate, p.truth).empty(); })) {
    entries.push_back({Mark::dashes, lost_color, std::max(2.0, 0.2 * font), "lost"});
  }
  if (!entries.empty()) entries.push_back({Mark::ring, truth_color, 0.28 * font, "start"});
  const double legend = draw_legend(nullptr, entries, {}, page.width() - 2.0 * gap, font);

  const double width = (page.width() - (columns + 1) * gap) / columns;
  const double row_height = (page.height() - legend - gap) / rows;
  const double head = 1.5 * font;
  int words_size = size;
  for (const TrajectoryPanel& panel : figure.panels) {
    words_size = std::min(words_size, fit_text(panel.words, size, width, 0.6).size);
  }
  for (int k = 0; k < count; ++k) {
    const TrajectoryPanel& panel = figure.panels[static_cast<std::size_t>(k)];
    const double x = gap + (k % columns) * (width + gap);
    const int row = k / columns;
    const double y = row * row_height + 0.2 * font;
    const FittedText words = fit_text(panel.words, words_size, width, 0.6);
    page.text(words.text, {x + 0.5 * width, y + 0.5 * head},
              {.size = static_cast<double>(words.size), .x = AlignX::center});
    const cv::Rect box(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y + head)),
                       std::max(4, static_cast<int>(width)),
                       std::max(4, static_cast<int>(row_height - head - 0.2 * font)));
    draw_panel(page, panel, box, font);
  }
  draw_legend(&page, entries, {gap, page.height() - legend - 0.5 * gap}, page.width() - 2.0 * gap, font);
  return page.pixels();
}

}  // namespace odosplat
