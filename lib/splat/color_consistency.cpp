// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/color_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {

namespace {

constexpr double surroundings_px = 4.0;  // standard deviation of the window, in the reduced image
constexpr std::size_t least_points = 200;
// A hypothesis must leave at most this share of what the files leave: the rest is chance and the search's own gain.
constexpr double clearly_better = 0.8;

}  // namespace

void ColorConsistencyOptions::check() const {
  require(points >= 1, "points", "at least 1");
  require(views >= 2, "views", "at least 2");
  require(width >= 16, "width", "at least 16");
}

std::string GeometryHypothesis::words() const {
  char text[160];
  if (inverted) return "the poses are inverted (camera from world instead of world from camera)";
  if (focal != 1.0) {
    std::snprintf(text, sizeof(text), "the focal length is wrong (%.2f of it fits better)", focal);
    return text;
  }
  std::snprintf(text, sizeof(text), "the cloud lies %.2f m off the poses' frame (%+.2f %+.2f %+.2f m)", offset.norm(),
                offset.x(), offset.y(), offset.z());
  return text;
}

ColorConsistency::ColorConsistency(const PointCloud& cloud, TrainingViews& views,
                                   const ColorConsistencyOptions& options)
    : points_((options.check(), thinned_evenly(cloud, options.points))) {
  const int used = std::min(options.views, views.count());
  for (int k = 0; k < used; ++k) {
    const int i = static_cast<int>(static_cast<long>(k) * views.count() / used);
    View view{to_gray(views.color(i)), views.camera(i), views.T_world_camera(i)};
    if (view.camera.width > options.width) {
      const double ratio = static_cast<double>(options.width) / view.camera.width;
      const int height = std::max(1, static_cast<int>(std::lround(ratio * view.camera.height)));
      view.camera = view.camera.resized(options.width, height);
      cv::resize(view.image, view.image, cv::Size(options.width, height), 0.0, 0.0, cv::INTER_AREA);
    }
    cv::Mat1f mean;
    cv::GaussianBlur(view.image, mean, cv::Size(), surroundings_px);
    view.image -= mean;
    views_.push_back(std::move(view));
  }
}

ColorConsistency::Value ColorConsistency::of(const GeometryHypothesis& hypothesis) const {
  std::vector<std::vector<std::pair<std::size_t, double>>> values(views_.size());
  parallel_for(static_cast<int>(views_.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const View& view = views_[static_cast<std::size_t>(k)];
      Camera camera = view.camera;
      camera.fx *= hypothesis.focal;
      camera.fy *= hypothesis.focal;
      const SE3 T = hypothesis.inverted ? view.T_world_camera.inverse() : view.T_world_camera;
      // A cloud that is moved by -offset is as good as cameras that are moved by +offset.
      const SE3 T_world_camera(T.rotation(), T.translation() + hypothesis.offset);
      for (const SeenPoints::Point& p : points_.in(camera, T_world_camera)) {
        const float u = std::clamp(p.u, 0.0F, static_cast<float>(camera.width - 1));
        const float v = std::clamp(p.v, 0.0F, static_cast<float>(camera.height - 1));
        if (view.image.cols < 2 || view.image.rows < 2) continue;
        values[static_cast<std::size_t>(k)].emplace_back(p.index, static_cast<double>(bilinear(view.image, u, v)));
      }
    }
  });
  std::vector<double> sums(points_.size(), 0.0);
  std::vector<double> squares(points_.size(), 0.0);
  std::vector<int> counts(points_.size(), 0);
  for (const auto& of_view : values) {
    for (const auto& [index, value] : of_view) {
      sums[index] += value;
      squares[index] += value * value;
      ++counts[index];
    }
  }
  Value result;
  double within = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (counts[i] < 2) continue;
    ++result.points;
    const double n = counts[i];
    within += (squares[i] - sums[i] * sums[i] / n) * n / (n - 1.0);
    all += squares[i];  // about zero, the mean of a value less its surroundings
  }
  if (result.points >= least_points && all > 0.0) result.unexplained = within / all;
  return result;
}

std::optional<GeometryDoubt> geometry_doubt(const ColorConsistency& consistency) {
  const ColorConsistency::Value given = consistency.of({});
  GeometryDoubt best{{}, given.unexplained, given.unexplained};
  // Fewer points in common than half would be judged on other places than the given geometry.
  const auto tried = [&](const GeometryHypothesis& hypothesis) {
    const ColorConsistency::Value value = consistency.of(hypothesis);
    if (2 * value.points < given.points || value.unexplained >= best.instead) return false;
    best.hypothesis = hypothesis;
    best.instead = value.unexplained;
    return true;
  };
  tried({.inverted = true});
  for (const double focal : {0.75, 0.8, 0.85, 0.9, 0.95, 1.05, 1.1, 1.15, 1.25, 1.35}) tried({.focal = focal});
  GeometryHypothesis moved;
  double least = given.unexplained;
  for (double step = 0.3; step > 0.02; step *= 0.5) {
    for (bool better = true; better;) {
      better = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {step, -step}) {
          GeometryHypothesis next = moved;
          next.offset[axis] += side;
          if (next.offset.norm() > 0.6) continue;
          const ColorConsistency::Value value = consistency.of(next);
          if (2 * value.points < given.points || value.unexplained >= least) continue;
          least = value.unexplained;
          moved = next;
          better = true;
        }
      }
    }
  }
  if (least < best.instead) {
    best.hypothesis = moved;
    best.instead = least;
  }
  if (!(best.instead < clearly_better * best.as_given)) return std::nullopt;
  return best;
}

}  // namespace odosplat
