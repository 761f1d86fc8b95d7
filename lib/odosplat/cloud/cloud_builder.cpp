// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_builder.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/cloud_batch.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

// Slope of the inverse depth [1/m/px] along one axis from the two neighbours (0 = none): the smaller of the two slopes,
// because the larger one may be across an edge.
double inverse_depth_slope(double before, double here, double after) {
  const double a = before > 0.0 ? 1.0 / here - 1.0 / before : 0.0;
  const double b = after > 0.0 ? 1.0 / after - 1.0 / here : 0.0;
  if (before <= 0.0) return b;
  if (after <= 0.0) return a;
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

void CloudOptions::check() const {
  require(std::isfinite(voxel) && voxel > 0.0, "voxel", "positive [m]");
  require(std::isfinite(noise) && noise >= 0.0, "noise", "at least 0 [m]");
  require(std::isfinite(min_depth) && min_depth > 0.0, "min_depth", "positive [m]");
  require(std::isfinite(max_depth) && max_depth > min_depth, "max_depth", "above min_depth [m]");
  require(std::isfinite(max_depth_step) && max_depth_step > 0.0, "max_depth_step", "positive");
  require(max_incidence > 0.0 && max_incidence <= 90.0, "max_incidence", "in 0..90 [deg]");
  require(normal_neighbors == 0 || normal_neighbors >= 3, "normal_neighbors", "0 or at least 3");
}

CloudBuilder::CloudBuilder(const CloudOptions& options) : options_((options.check(), options)), grid_(options.voxel) {}

void CloudBuilder::add(const DepthImage& depth, const ColorImage& color, const Camera& camera,
                       const SE3& T_world_camera) {
  camera.check();
  if (!T_world_camera.is_finite()) throw InputError("pose", "is not finite");
  if (depth.empty()) return;
  if (depth.cols != camera.width || depth.rows != camera.height) {
    throw InputError(
        "depth", "is " + size_text(depth.cols, depth.rows) + ", the camera " + size_text(camera.width, camera.height));
  }
  if (!color.empty() && color.size() != depth.size()) {
    throw InputError("colour",
                     "is " + size_text(color.cols, color.rows) + ", the depth " + size_text(depth.cols, depth.rows));
  }
  if (any_ && with_color_ == color.empty()) throw InputError("colour", "is there for some of the images only");
  any_ = true;
  with_color_ = !color.empty();

  const double min_cos = std::cos(options_.max_incidence * std::numbers::pi / 180.0);
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < depth.cols && y < depth.rows;
    const double z = inside ? static_cast<double>(depth(y, x)) : 0.0;
    return z > 0.0 && std::isfinite(z) ? z : 0.0;
  };
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double z = at(x, y);
      if (z < options_.min_depth || z > options_.max_depth) continue;
      const double left = at(x - 1, y);
      const double right = at(x + 1, y);
      const double up = at(x, y - 1);
      const double down = at(x, y + 1);
      const double too_near = z * (1.0 - options_.max_depth_step);
      const auto hides = [&](double neighbor) { return neighbor > 0.0 && neighbor < too_near; };
      if (hides(left) || hides(right) || hides(up) || hides(down)) continue;
      // A neighbour that is farther by more than max_depth_step belongs to another surface and is not used for the
      // slope.
      const auto same_surface = [&](double neighbor) {
        return z < neighbor * (1.0 - options_.max_depth_step) ? 0.0 : neighbor;
      };

      // A plane n.p = 1 has inverse depth n.f along the ray f = (.., .., 1), linear in the pixel: its slopes give n.
      const Eigen::Vector3d ray = camera.ray(x, y);
      const double nx = inverse_depth_slope(same_surface(left), z, same_surface(right)) * camera.fx;
      const double ny = inverse_depth_slope(same_surface(up), z, same_surface(down)) * camera.fy;
      const Eigen::Vector3d n(nx, ny, 1.0 / z - nx * ray.x() - ny * ray.y());
      if (1.0 / z < min_cos * n.norm() * ray.norm()) continue;

      const Eigen::Vector3d p_world = T_world_camera * (z * ray);
      VoxelGrid::Cell* cell = grid_.at(p_world);
      if (!cell) continue;
      cell->point += p_world;
      cell->normal += (T_world_camera.rotation() * ray.normalized()).cast<float>();
      if (with_color_) cell->color += Eigen::Vector3f(color(y, x)[0], color(y, x)[1], color(y, x)[2]);
      ++cell->count;
    }
  }
}

PointCloud CloudBuilder::finish() const {
  PointCloud cloud;
  std::vector<Eigen::Vector3f> rays;
  Random random(options_.seed);
  for (const VoxelGrid::Cell& cell : grid_.cells()) {
    // Rays from opposite sides can cancel; the point is then not moved and its normal not turned.
    const float length = cell.normal.norm();
    const Eigen::Vector3f ray = length > 1e-3F ? Eigen::Vector3f(cell.normal / length) : Eigen::Vector3f::Zero();
    const double shift = options_.noise > 0.0 ? options_.noise * random.normal() : 0.0;
    cloud.points.push_back(round_point("cloud", cell.point / cell.count + shift * ray.cast<double>()));
    if (with_color_) cloud.colors.emplace_back(cell.color / static_cast<float>(cell.count));
    rays.push_back(ray);
  }
  if (options_.normal_neighbors > 0) {
    estimate_normals(cloud, options_.normal_neighbors);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.normals[i].dot(rays[i]) > 0.0F) cloud.normals[i] = -cloud.normals[i];
    }
  }
  return cloud;
}

}  // namespace odosplat
