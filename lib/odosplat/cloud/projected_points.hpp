// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A point of a cloud projected into a camera, with the plane around it.
struct ProjectedPoint {
  float u, v;           // [px]
  float inverse_depth;  // [1/m]
  float slope_u;        // [1/m/px] of the plane's inverse depth
  float slope_v;
  float spacing;             // [m]
  Eigen::Vector3f p_camera;  // [m]
  Eigen::Vector3f n_camera;  // unit normal, facing the camera
  float cosine;              // of the angle between normal and ray, at least 0.1
  int index;                 // in the cloud

  /// Inverse depth [1/m] of the plane at a pixel.
  float inverse_depth_at(float x, float y) const { return inverse_depth + slope_u * (x - u) + slope_v * (y - v); }
};

/// Width [px] of the margin around the image in which points are kept too, so that pixels at the image's border have
/// neighbours on both sides.
inline constexpr int projection_margin = 8;

/// The points of a cloud (with normals) whose depth is min_depth or more and whose disc of radius reach * spacing
/// touches the image or its margin, in the cloud's order. Normals of planes seen at less than 6 degrees are tilted to
/// that angle, because a plane seen edge-on has no defined depth.
std::vector<ProjectedPoint> project_points(const PointCloud& cloud, const std::vector<float>& spacings,
                                           const Camera& camera, const SE3& T_world_camera, double min_depth,
                                           double reach);

/// The nearest depth [m] among the points' discs at each pixel of the image and its margin (pixel (x, y) is at column
/// x + projection_margin); infinite where there is no disc. Discs have the radius reach * spacing and cover at least
/// the pixel of their centre.
cv::Mat1f splat_discs(const std::vector<ProjectedPoint>& points, const Camera& camera, double reach);

/// Points sorted into square cells of an image and its margin, to find those nearest to a pixel.
class PointGrid {
 public:
  static constexpr int max_found = 6;
  struct Found {
    int count = 0;
    int points[max_found] = {};
    float squared_distances[max_found] = {};  // [px^2], ascending
  };

  /// points must outlive the grid and lie within the image and its margin.
  PointGrid(const std::vector<ProjectedPoint>& points, const Camera& camera);

  /// The up to max_found points nearest to the pixel, within radius [px], for which accept(point, squared distance) is
  /// true. At equal distances the point with the lower index comes first.
  template <typename Accept>
  Found nearest(float x, float y, float radius, const Accept& accept) const;

 private:
  int column(float u) const;
  int row(float v) const;

  const std::vector<ProjectedPoint>& points_;
  float cell_ = 1.0F;  // [px]
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> begins_;  // start of each cell in order_
  std::vector<int> order_;
};

template <typename Accept>
PointGrid::Found PointGrid::nearest(float x, float y, float radius, const Accept& accept) const {
  Found found;
  const int cx = column(x);
  const int cy = row(y);
  const float left = x + static_cast<float>(projection_margin) + 0.5F - static_cast<float>(cx) * cell_;
  const float top = y + static_cast<float>(projection_margin) + 0.5F - static_cast<float>(cy) * cell_;
  const float to_border = std::min(std::min(left, cell_ - left), std::min(top, cell_ - top));
  float limit = radius * radius;
  const auto visit = [&](int c, int r) {
    const auto cell = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
    for (int k = begins_[cell]; k < begins_[cell + 1]; ++k) {
      const int candidate = order_[static_cast<std::size_t>(k)];
      const ProjectedPoint& p = points_[static_cast<std::size_t>(candidate)];
      const float d = (p.u - x) * (p.u - x) + (p.v - y) * (p.v - y);
      if (d > limit) continue;
      if (found.count == max_found &&
          (d > found.squared_distances[max_found - 1] ||
           (d == found.squared_distances[max_found - 1] && candidate > found.points[max_found - 1]))) {
        continue;
      }
      if (!accept(p, d)) continue;
      int slot = found.count < max_found ? found.count++ : max_found - 1;
      while (slot > 0 && (found.squared_distances[slot - 1] > d ||
                          (found.squared_distances[slot - 1] == d && found.points[slot - 1] > candidate))) {
        found.squared_distances[slot] = found.squared_distances[slot - 1];
        found.points[slot] = found.points[slot - 1];
        --slot;
      }
      found.squared_distances[slot] = d;
      found.points[slot] = candidate;
      if (found.count == max_found) limit = found.squared_distances[max_found - 1];
    }
  };
  for (int ring = 0;; ++ring) {
    const int c0 = std::max(0, cx - ring);
    const int c1 = std::min(columns_ - 1, cx + ring);
    for (int r = std::max(0, cy - ring); r <= std::min(rows_ - 1, cy + ring); ++r) {
      if (r == cy - ring || r == cy + ring) {
        for (int c = c0; c <= c1; ++c) visit(c, r);
      } else {
        if (cx - ring >= 0) visit(cx - ring, r);
        if (cx + ring < columns_) visit(cx + ring, r);
      }
    }
    const float searched = to_border + static_cast<float>(ring) * cell_;
    if (searched * searched > limit) break;
    if (cx - ring <= 0 && cy - ring <= 0 && cx + ring >= columns_ - 1 && cy + ring >= rows_ - 1) break;
  }
  return found;
}

}  // namespace odosplat
