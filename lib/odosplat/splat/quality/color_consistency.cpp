// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/color_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "odosplat/cloud/length_units.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {

namespace {

constexpr double surroundings_px = 4.0;  // standard deviation of the window, in the reduced image
constexpr std::size_t least_points = 200;
// A hypothesis must leave at most this share of what the given geometry leaves: a smaller gain may be due to chance,
// and to the search itself.
constexpr double clearly_better = 0.8;
constexpr double least_spread = 0.5;  // of the points in the images, as a share of that with the given geometry
constexpr double least_gain = 0.05;   // and by this much less: with next to nothing unexplained, a ratio means nothing

}  // namespace

void ColorConsistencyOptions::check() const {
  require(points >= 1, "points", "at least 1");
  require(views >= 2, "views", "at least 2");
  require(width >= 16, "width", "at least 16");
}

std::string GeometryHypothesis::words() const {
  if (inverted) return "the poses are inverted (camera from world instead of world from camera)";
  if (unit != 1.0) return formatted("%s (%.4g times as large as the poses say)", unit_words(unit).c_str(), unit);
  if (focal != 1.0) return formatted("the focal length is wrong (%.2f times the given one fits better)", focal);
  return formatted("the cloud lies %.2f m off the frame of the poses (%+.2f %+.2f %+.2f m)", offset.norm(), offset.x(),
                   offset.y(), offset.z());
}

ColorConsistency::ColorConsistency(const PointCloud& cloud, TrainingViews& views,
                                   const ColorConsistencyOptions& options)
    : ColorConsistency((options.check(), thinned_evenly(cloud, options.points)), views, options, 0) {}

ColorConsistency::ColorConsistency(const PointCloud& thinned, TrainingViews& views,
                                   const ColorConsistencyOptions& options, int)
    : points_(thinned) {
  for (const Eigen::Vector3f& c : thinned.colors) grays_.push_back(c.dot(Eigen::Vector3f(0.299F, 0.587F, 0.114F)));
  const int used = std::min(options.views, views.count());
  for (int k = 0; k < used; ++k) {
    const int i = static_cast<int>(static_cast<long>(k) * views.count() / used);
    View view{to_gray(views.color(i)), {}, views.camera(i), views.T_world_camera(i)};
    if (view.camera.width > options.width) {
      const double ratio = static_cast<double>(options.width) / view.camera.width;
      const int height = std::max(1, static_cast<int>(std::lround(ratio * view.camera.height)));
      view.camera = view.camera.resized(options.width, height);
      cv::resize(view.gray, view.gray, cv::Size(options.width, height), 0.0, 0.0, cv::INTER_AREA);
    }
    if (view.gray.cols < 2 || view.gray.rows < 2) continue;  // nothing to interpolate
    cv::Mat1f mean;
    cv::GaussianBlur(view.gray, mean, cv::Size(), surroundings_px);
    view.detail = view.gray - mean;
    views_.push_back(std::move(view));
  }
}

namespace {

/// 1 - r^2 of pairs, from their sums; 1 where there is nothing to correlate.
struct Correlation {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  void add(double a, double b) {
    n += 1.0;
    x += a;
    y += b;
    xx += a * a;
    yy += b * b;
    xy += a * b;
  }
  double unexplained() const {
    const double covariance = n * xy - x * y;
    const double variances = (n * xx - x * x) * (n * yy - y * y);
    if (!(variances > 0.0) || covariance <= 0.0) return 1.0;
    return std::clamp(1.0 - covariance * covariance / variances, 0.0, 1.0);
  }
};

struct Observation {
  std::size_t point;
  double detail;
  Eigen::Vector2d pixel;
};

double spread_of(const std::vector<std::vector<Observation>>& values) {
  double squares = 0.0;
  double count = 0.0;
  for (const auto& of_view : values) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Observation& o : of_view) mean += o.pixel / static_cast<double>(of_view.size());
    for (const Observation& o : of_view) squares += (o.pixel - mean).squaredNorm();
    count += static_cast<double>(of_view.size());
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

ColorConsistency::Value ColorConsistency::of(const GeometryHypothesis& hypothesis) const {
  std::vector<std::vector<Observation>> values(views_.size());
  std::vector<Correlation> with_cloud(views_.size());  // each view has an exposure of its own
  parallel_for(static_cast<int>(views_.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const View& view = views_[at];
      Camera camera = view.camera;
      camera.fx *= hypothesis.focal;
      camera.fy *= hypothesis.focal;
      const SE3 T = hypothesis.inverted ? view.T_world_camera.inverse() : view.T_world_camera;
      // Moving the cloud by -offset is equivalent to moving the cameras by +offset, and shrinking it is equivalent to
      // enlarging the distances between the cameras.
      const SE3 T_world_camera(T.rotation(), hypothesis.unit * T.translation() + hypothesis.offset);
      for (const SeenPoints::Point& p : points_.in(camera, T_world_camera)) {
        const float u = std::clamp(p.u, 0.0F, static_cast<float>(camera.width - 1));
        const float v = std::clamp(p.v, 0.0F, static_cast<float>(camera.height - 1));
        values[at].push_back({p.index, static_cast<double>(bilinear(view.detail, u, v)), Eigen::Vector2d(p.u, p.v)});
        if (!grays_.empty())
          with_cloud[at].add(static_cast<double>(grays_[p.index]), static_cast<double>(bilinear(view.gray, u, v)));
      }
    }
  });
  std::vector<double> sums(points_.size(), 0.0);
  std::vector<double> squares(points_.size(), 0.0);
  std::vector<int> counts(points_.size(), 0);
  for (const auto& of_view : values) {
    for (const Observation& o : of_view) {
      sums[o.point] += o.detail;
      squares[o.point] += o.detail * o.detail;
      ++counts[o.point];
    }
  }
  Value result;
  result.spread_px = spread_of(values);
  double within = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (counts[i] < 2) continue;
    ++result.points;
    const double n = counts[i];
    within += (squares[i] - sums[i] * sums[i] / n) * n / (n - 1.0);
    all += squares[i];  // about 0, which is the mean of values less their surroundings' mean
  }
  if (result.points < least_points || !(all > 0.0)) return result;
  result.unexplained = within / all;
  if (grays_.empty()) return result;
  double weighted = 0.0;
  double pairs = 0.0;
  for (const Correlation& c : with_cloud) {
    weighted += c.n * c.unexplained();
    pairs += c.n;
  }
  result.unexplained = std::sqrt(result.unexplained * weighted / pairs);
  return result;
}

std::optional<GeometryDoubt> geometry_doubt(const ColorConsistency& consistency) {
  const ColorConsistency::Value given = consistency.of({});
  GeometryDoubt best{{}, given.unexplained, given.unexplained};
  // With fewer than half the points in common, other places would be compared than with the given geometry.
  const auto tried = [&](const GeometryHypothesis& hypothesis) {
    const ColorConsistency::Value value = consistency.of(hypothesis);
    if (2 * value.points < given.points || value.unexplained >= best.instead) return false;
    // A cloud that is shrunk to a spot looks alike in all images.
    if (value.spread_px < least_spread * given.spread_px) return false;
    best.hypothesis = hypothesis;
    best.instead = value.unexplained;
    return true;
  };
  tried({.inverted = true});
  for (const CoordinateUnit& unit : length_units) tried({.unit = unit.times});
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
  // Three free numbers fit better by chance than one does.
  if (least < clearly_better * best.instead) {
    best.hypothesis = moved;
    best.instead = least;
  }
  // A hypothesis with which the images still disagree is not the cause.
  if (best.instead > most_unexplained) return std::nullopt;
  if (!(best.instead < clearly_better * best.as_given) || best.as_given - best.instead < least_gain)
    return std::nullopt;
  return best;
}

}  // namespace odosplat
