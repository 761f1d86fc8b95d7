// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/projected_points.hpp"

#include <cmath>
#include <limits>

#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

constexpr float min_cosine = 0.1F;
constexpr int points_a_chunk = 4096;
constexpr int rows_a_chunk = 32;

// Radius [px] of a disc's bounding box, at the depth of the disc's near side.
float reach_px(const ProjectedPoint& p, const Camera& camera, float reach) {
  const float radius = reach * p.spacing;
  const float z = std::max(p.p_camera.z() - radius, 0.5F * p.p_camera.z());
  return static_cast<float>(std::max(camera.fx, camera.fy)) * radius / z;
}

bool touches(const ProjectedPoint& p, const Camera& camera, float radius) {
  const float pad = static_cast<float>(projection_margin) + 0.5F + radius;
  return p.u > -pad && p.v > -pad && p.u < static_cast<float>(camera.width) - 1.0F + pad &&
         p.v < static_cast<float>(camera.height) - 1.0F + pad;
}

ProjectedPoint project(const Eigen::Vector3f& p_camera, Eigen::Vector3f n, float spacing, int index,
                       const Camera& camera) {
  ProjectedPoint p;
  p.p_camera = p_camera;
  p.spacing = spacing;
  p.index = index;
  const Eigen::Vector2d pixel = camera.project(p_camera.cast<double>());
  p.u = static_cast<float>(pixel.x());
  p.v = static_cast<float>(pixel.y());
  p.inverse_depth = 1.0F / p_camera.z();
  const Eigen::Vector3f direction = p_camera.normalized();
  if (n.dot(direction) > 0.0F) n = -n;
  if (n.dot(direction) > -min_cosine) {
    const Eigen::Vector3f across = (n - n.dot(direction) * direction).normalized();
    n = std::sqrt(1.0F - min_cosine * min_cosine) * across - min_cosine * direction;
  }
  p.n_camera = n;
  p.cosine = -n.dot(direction);
  // The plane's inverse depth along the ray f is n.f / n.p.
  const float n_p = n.dot(p_camera);
  p.slope_u = n.x() / (n_p * static_cast<float>(camera.fx));
  p.slope_v = n.y() / (n_p * static_cast<float>(camera.fy));
  return p;
}

}  // namespace

std::vector<ProjectedPoint> project_points(const PointCloud& cloud, const std::vector<float>& spacings,
                                           const Camera& camera, const SE3& T_world_camera, double min_depth,
                                           double reach) {
  const SE3 T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
  const Eigen::Vector3d& t = T_camera_world.translation();
  const Eigen::Matrix3f Rf = R.cast<float>();
  const int n = static_cast<int>(cloud.size());
  std::vector<std::vector<ProjectedPoint>> chunks(static_cast<std::size_t>((n + points_a_chunk - 1) / points_a_chunk));
  parallel_for(n, points_a_chunk, [&](int begin, int end) {
    std::vector<ProjectedPoint>& chunk = chunks[static_cast<std::size_t>(begin / points_a_chunk)];
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Vector3d p_camera = R * cloud.points[at].cast<double>() + t;
      if (!(p_camera.z() >= min_depth)) continue;
      const ProjectedPoint p = project(p_camera.cast<float>(), Rf * cloud.normals[at], spacings[at], i, camera);
      if (touches(p, camera, reach_px(p, camera, static_cast<float>(reach)))) chunk.push_back(p);
    }
  });
  std::vector<ProjectedPoint> all;
  for (const std::vector<ProjectedPoint>& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

cv::Mat1f splat_discs(const std::vector<ProjectedPoint>& points, const Camera& camera, double reach) {
  const int width = camera.width + 2 * projection_margin;
  const int height = camera.height + 2 * projection_margin;
  cv::Mat1f nearest(height, width, std::numeric_limits<float>::infinity());
  const float margin = static_cast<float>(projection_margin);
  const float inverse_fx = static_cast<float>(1.0 / camera.fx);
  const float inverse_fy = static_cast<float>(1.0 / camera.fy);
  parallel_for(height, rows_a_chunk, [&](int row_begin, int row_end) {
    for (const ProjectedPoint& p : points) {
      const float radius = reach_px(p, camera, static_cast<float>(reach));
      const float u = p.u + margin;
      const float v = p.v + margin;
      // Clamped as floats before the conversion: discs very near to the camera can exceed the range of int.
      const int y0 = static_cast<int>(std::max(std::ceil(v - radius), static_cast<float>(row_begin)));
      const int y1 = static_cast<int>(std::min(std::floor(v + radius), static_cast<float>(row_end - 1)));
      const int x0 = static_cast<int>(std::max(std::ceil(u - radius), 0.0F));
      const int x1 = static_cast<int>(std::min(std::floor(u + radius), static_cast<float>(width - 1)));
      const float squared_radius = static_cast<float>(reach * reach) * p.spacing * p.spacing;
      const Eigen::Vector3f ray = p.p_camera / p.p_camera.z();
      for (int y = y0; y <= y1; ++y) {
        const float dy = static_cast<float>(y) - v;
        float* out = nearest[y];
        for (int x = x0; x <= x1; ++x) {
          const float dx = static_cast<float>(x) - u;
          const float inverse_depth = p.inverse_depth + p.slope_u * dx + p.slope_v * dy;
          if (!(inverse_depth > 0.0F)) continue;
          const float z = 1.0F / inverse_depth;
          const Eigen::Vector3f q(z * (ray.x() + dx * inverse_fx), z * (ray.y() + dy * inverse_fy), z);
          if ((q - p.p_camera).squaredNorm() <= squared_radius && z < out[x]) out[x] = z;
        }
      }
      const float centre_x = std::round(u);
      const float centre_y = std::round(v);
      if (centre_y >= static_cast<float>(row_begin) && centre_y < static_cast<float>(row_end) && centre_x >= 0.0F &&
          centre_x < static_cast<float>(width)) {
        float& out = nearest(static_cast<int>(centre_y), static_cast<int>(centre_x));
        out = std::min(out, p.p_camera.z());
      }
    }
  });
  return nearest;
}

PointGrid::PointGrid(const std::vector<ProjectedPoint>& points, const Camera& camera) : points_(points) {
  const int width = camera.width + 2 * projection_margin;
  const int height = camera.height + 2 * projection_margin;
  // About two points per cell, a compromise between visiting empty cells and visiting points that are too far away.
  const float a_point = static_cast<float>(width) * static_cast<float>(height) /
                        static_cast<float>(std::max<std::size_t>(points.size(), 1));
  cell_ = std::clamp(std::sqrt(2.0F * a_point), 1.0F, 8.0F);
  columns_ = static_cast<int>(std::ceil(static_cast<float>(width) / cell_));
  rows_ = static_cast<int>(std::ceil(static_cast<float>(height) / cell_));
  begins_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  std::vector<int> cells(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells[i] = row(points[i].v) * columns_ + column(points[i].u);
    ++begins_[static_cast<std::size_t>(cells[i]) + 1];
  }
  for (std::size_t c = 1; c < begins_.size(); ++c) begins_[c] += begins_[c - 1];
  std::vector<int> next(begins_.begin(), begins_.end() - 1);
  order_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    order_[static_cast<std::size_t>(next[static_cast<std::size_t>(cells[i])]++)] = static_cast<int>(i);
  }
}

int PointGrid::column(float u) const {
  return std::clamp(static_cast<int>((u + static_cast<float>(projection_margin) + 0.5F) / cell_), 0, columns_ - 1);
}

int PointGrid::row(float v) const {
  return std::clamp(static_cast<int>((v + static_cast<float>(projection_margin) + 0.5F) / cell_), 0, rows_ - 1);
}

}  // namespace odosplat
