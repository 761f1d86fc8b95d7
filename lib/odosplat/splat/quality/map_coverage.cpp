// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// What training images show: of the cloud, of the directions, and of the map against them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/quality/map_quality.hpp"
#include "odosplat/splat/quality/seen_points.hpp"
#include "odosplat/splat/train/losses.hpp"

namespace odosplat {

namespace {

constexpr int most_views = 200;
constexpr std::size_t most_points = 100000;

bool in_image(const Camera& camera, const Eigen::Vector3d& p_camera) {
  if (!(p_camera.z() > 0.0)) return false;
  const Eigen::Vector2d pixel = camera.project(p_camera);
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width - 0.5 && pixel.y() < camera.height - 0.5;
}

/// Share of each face of a cube around the world's origin whose directions some view looks in.
std::array<double, 6> covered_directions(const TrainingViews& views) {
  constexpr int cells = 16;  // along an edge of a face: directions about 6 degrees apart
  std::array<double, 6> shares{};
  for (std::size_t face = 0; face < 6; ++face) {
    const auto axis = static_cast<Eigen::Index>(face / 2);
    std::vector<Eigen::Vector3d> open;
    for (int i = 0; i < cells * cells; ++i) {
      Eigen::Vector3d direction;
      direction[axis] = face % 2 == 0 ? 1.0 : -1.0;
      direction[(axis + 1) % 3] = (2.0 * (i % cells) + 1.0) / cells - 1.0;
      direction[(axis + 2) % 3] = (2.0 * (i / cells) + 1.0) / cells - 1.0;  // NOLINT(bugprone-integer-division)
      open.push_back(direction);
    }
    for (int view = 0; view < views.count() && !open.empty(); ++view) {
      const Eigen::Matrix3d R_camera_world = views.T_world_camera(view).rotation_matrix().transpose();
      const Camera camera = views.camera(view);
      std::erase_if(open, [&](const Eigen::Vector3d& d) { return in_image(camera, R_camera_world * d); });
    }
    shares[face] = 1.0 - static_cast<double>(open.size()) / (cells * cells);
  }
  return shares;
}

double psnr_db(const ColorImage& rendered, const ColorImage& image, const std::array<double, Exposures::settings>& e) {
  double sum = 0.0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        const double value = e[channel] * static_cast<double>(rendered(y, x)[c]) + e[3 + channel];
        const double difference = value - static_cast<double>(image(y, x)[c]);
        sum += difference * difference;
      }
    }
  }
  return LossValue{0.0, 0.0, sum / (3.0 * static_cast<double>(image.total())), 0.0}.psnr_db();
}

void compare_depth(const DepthImage& depth, const DepthImage& surface, ViewQuality& quality) {
  std::vector<float> errors;
  std::vector<float> shares;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float z = surface(y, x);
      if (!(depth(y, x) > 0.0F) || !(z > 0.0F)) continue;
      errors.push_back(std::abs(depth(y, x) - z));
      shares.push_back(errors.back() / z);
    }
  }
  if (errors.empty()) return;
  quality.depth_error_m = static_cast<double>(upper_median(std::move(errors)));
  quality.depth_error_share = static_cast<double>(upper_median(std::move(shares)));
}

}  // namespace

bool any_in_view(const PointCloud& cloud, const TrainingViews& views, bool inverted) {
  for (int view = 0; view < views.count(); ++view) {
    const Camera camera = views.camera(view);
    const SE3 given = views.T_world_camera(view);
    const SE3 T_camera_world = inverted ? given : given.inverse();
    for (const Eigen::Vector3f& p_world : cloud.points)
      if (in_image(camera, T_camera_world * p_world.cast<double>())) return true;
  }
  return false;
}

CloudCoverage cloud_coverage(const PointCloud& cloud, const TrainingViews& views) {
  CloudCoverage coverage;
  coverage.directions = covered_directions(views);
  const SeenPoints points(thinned_evenly(cloud, most_points));
  std::vector<int> counts(points.size(), 0);
  const int used = std::min(most_views, views.count());
  for (int k = 0; k < used; ++k) {
    const int view = static_cast<int>(static_cast<long>(k) * views.count() / used);
    for (const SeenPoints::Point& p : points.in(views.camera(view), views.T_world_camera(view))) ++counts[p.index];
  }
  const auto seen = std::partition(counts.begin(), counts.end(), [](int count) { return count > 0; });
  if (counts.empty()) return coverage;
  coverage.unseen_share = static_cast<double>(counts.end() - seen) / static_cast<double>(counts.size());
  if (seen == counts.begin()) return coverage;
  const auto middle = counts.begin() + (seen - counts.begin()) / 2;
  std::nth_element(counts.begin(), middle, seen);
  coverage.images_a_point = static_cast<double>(*middle) * views.count() / used;
  return coverage;
}

std::vector<ViewQuality> view_qualities(const compute::Context& context, const Gaussians& gaussians,
                                        TrainingViews& views, MapView* surface, const Exposures& exposures,
                                        const RasterizerOptions& options) {
  GaussianViewOptions view_options;
  view_options.rasterizer = options;
  GaussianView map(context, gaussians, view_options);
  std::vector<ViewQuality> qualities;
  for (int view = 0; view < views.count(); ++view) {
    const Camera camera = views.camera(view);
    const SE3 T_world_camera = views.T_world_camera(view);
    const ViewImages images = map.render(camera, T_world_camera, {true, true});
    ViewQuality quality;
    quality.psnr_db = psnr_db(images.color, views.color(view), exposures.of(view));
    quality.covered = static_cast<double>(cv::countNonZero(images.depth)) / static_cast<double>(images.depth.total());
    if (surface != nullptr) compare_depth(images.depth, surface->render(camera, T_world_camera, {}).depth, quality);
    qualities.push_back(quality);
  }
  mark_odd(qualities);
  return qualities;
}

}  // namespace odosplat
