// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/points/immature_points.hpp"

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"

namespace odosplat {

void ImmaturePointOptions::check() const {
  require(points >= 0, "immature.points", "at least 0");
  require(min_share >= 0.0 && min_share <= 1.0, "immature.min_share", "in [0, 1]");
  require(min_depth > 0.0 && max_depth > min_depth, "immature.min_depth", "positive, below max_depth");
  require(depth_interval > 0.0 && depth_interval < 1.0, "immature.depth_interval", "between 0 and 1");
  require(max_outliers >= 1, "immature.max_outliers", "at least 1");
  search.check();
}

ImmaturePoint make_immature_point(const GradientImage& gradient, const cv::Point& pixel, double gradient_weight) {
  ImmaturePoint point;
  point.u = static_cast<float>(pixel.x);
  point.v = static_cast<float>(pixel.y);
  sample_pattern(gradient, pixel, gradient_weight, point.intensity, point.weight);
  for (const auto& [du, dv] : pattern) {
    const float* g = gradient.ptr<float>(pixel.y + dv) + 4 * (pixel.x + du);
    const Eigen::Vector2f slope(g[1], g[2]);
    point.tensor += slope * slope.transpose();
  }
  return point;
}

std::vector<ImmaturePoint> make_immature_points(std::span<const GradientImage> gradients, const cv::Mat1f& depth,
                                                double gradient_weight, PixelSelector& selector,
                                                const ImmaturePointOptions& options) {
  std::vector<ImmaturePoint> points;
  if (gradients.empty() || gradients[0].empty() || options.points == 0) return points;
  const GradientImage& gradient = gradients[0];
  cv::Mat1b mask;
  double share = 1.0;
  if (!depth.empty()) {
    mask = depth <= 0.0F;
    share = static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
  }
  if (share < options.min_share) return points;
  for (const cv::Point& pixel : selector.select(gradients, mask, static_cast<int>(options.points * share))) {
    points.push_back(make_immature_point(gradient, pixel, gradient_weight));
    points.back().min_q = 1.0 / options.max_depth;
    points.back().max_q = 1.0 / options.min_depth;
  }
  return points;
}

void trace_points(std::vector<ImmaturePoint>& points, const SE3& T_target_host, const FramePyramid& target,
                  const Brightness& brightness, const ImmaturePointOptions& options) {
  constexpr int chunk = 64;
  const Camera& camera = target.cameras.front();
  const bool rolling = !target.row_motion.isZero(0.0);
  const auto T_row_host = [&](const ImmaturePoint& point) {
    if (!rolling) return T_target_host;
    const double q = 0.5 * (point.min_q + point.max_q);
    return at_its_row(T_target_host, camera, camera.ray(point.u, point.v) / q, target.row_motion);
  };
  parallel_for(static_cast<int>(points.size()), chunk, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      ImmaturePoint& point = points[static_cast<std::size_t>(i)];
      const SearchResult found =
          search_epipolar_line(point, T_row_host(point), camera, target.gray.front(), brightness, options.search);
      point.status = found.status;
      if (found.status != SearchStatus::out_of_view) point.length = found.length;
      if (found.status == SearchStatus::outlier) {
        ++point.outliers;
      } else if (found.status == SearchStatus::good) {
        point.outliers = 0;
        ++point.found;
        point.quality = found.quality;
        point.min_q = found.min_q;
        point.max_q = found.max_q;
      }
    }
  });
  std::erase_if(points, [&](const ImmaturePoint& p) { return p.outliers >= options.max_outliers; });
}

}  // namespace odosplat
