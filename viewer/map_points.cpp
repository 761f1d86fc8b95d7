// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/map_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int neighbors = 8;

void check(const MapPoints& map) {
  const auto fits = [&](std::size_t n) { return n == 0 || n == map.cloud.points.size(); };
  require(fits(map.cloud.colors.size()), "map colours", "as many as its points");
  require(fits(map.cloud.normals.size()), "map normals", "as many as its points");
  require(fits(map.radii.size()), "map radii", "as many as its points");
}

template <typename T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& kept) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

void drop_broken(MapPoints& map) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < map.cloud.points.size(); ++i) {
    const bool sound = map.cloud.points[i].allFinite() &&
                       (map.radii.empty() || (std::isfinite(map.radii[i]) && map.radii[i] > 0.0F)) &&
                       (map.cloud.normals.empty() || map.cloud.normals[i].allFinite());
    if (sound) kept.push_back(i);
  }
  if (kept.size() == map.cloud.points.size()) return;
  keep(map.cloud.points, kept);
  keep(map.cloud.colors, kept);
  keep(map.cloud.normals, kept);
  keep(map.radii, kept);
}

/// Positions of about 100 cameras, evenly spaced; they determine the visible side of each surface.
std::vector<Eigen::Vector3d> some_positions(const Trajectory& cameras) {
  std::vector<Eigen::Vector3d> positions;
  const std::size_t stride = cameras.size() / 100 + 1;
  for (std::size_t i = 0; i < cameras.size(); i += stride) {
    if (cameras[i].T_world_camera.is_finite()) positions.push_back(cameras[i].T_world_camera.translation());
  }
  return positions;
}

void turn_normals(MapPoints& map, const std::vector<Eigen::Vector3d>& positions) {
  for (std::size_t i = 0; i < map.cloud.points.size(); ++i) {
    const Eigen::Vector3d p = map.cloud.points[i].cast<double>();
    const auto nearest = std::ranges::min_element(
        positions, {}, [&](const Eigen::Vector3d& position) { return (position - p).squaredNorm(); });
    Eigen::Vector3f& normal = map.cloud.normals[i];
    if (normal.cast<double>().dot(*nearest - p) < 0.0) normal = -normal;
  }
}

double share_quantile(std::vector<double>& values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

double find_cut(const MapScenery& scenery, const std::vector<Eigen::Vector3d>& positions) {
  if (positions.empty() || scenery.map.cloud.points.empty()) return std::numeric_limits<double>::infinity();
  std::vector<double> heights;
  for (const auto& p : scenery.map.cloud.points) heights.push_back(p.cast<double>().dot(scenery.axes.up));
  const double floor = share_quantile(heights, 0.02);
  double top = -std::numeric_limits<double>::max();
  for (const auto& p : positions) top = std::max(top, p.dot(scenery.axes.up));
  return top + 0.25 * std::max(top - floor, 0.0);
}

/// A subset of the points below the cut, within the 1 % to 99 % quantiles along each axis.
void find_extent(MapScenery& scenery) {
  const std::array<Eigen::Vector3d, 3> directions{scenery.axes.right, scenery.axes.forward, scenery.axes.up};
  const PointCloud& cloud = scenery.map.cloud;
  std::vector<std::size_t> candidates;
  const std::size_t stride = cloud.points.size() / 20000 + 1;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (cloud.points[i].cast<double>().dot(scenery.axes.up) <= scenery.cut_height) candidates.push_back(i);
  }
  if (candidates.empty()) return;
  std::vector<std::size_t> kept = candidates;
  for (const auto& direction : directions) {
    const auto along = [&](std::size_t i) { return cloud.points[i].cast<double>().dot(direction); };
    std::vector<double> values;
    values.reserve(candidates.size());
    for (const std::size_t i : candidates) values.push_back(along(i));
    const double low = share_quantile(values, 0.01);
    const double high = share_quantile(values, 0.99);
    std::erase_if(kept, [&](std::size_t i) { return along(i) < low || along(i) > high; });
  }
  for (const std::size_t i : kept.empty() ? candidates : kept) {
    scenery.extent.push_back(cloud.points[i].cast<double>());
    if (scenery.one_sided) scenery.extent_normals.push_back(cloud.normals[i]);
  }
}

Eigen::Vector3d line_of_sight(const PlanAxes& axes, double azimuth, double elevation) {
  const Eigen::Vector3d level = std::cos(azimuth) * axes.forward + std::sin(azimuth) * axes.right;
  return std::cos(elevation) * level - std::sin(elevation) * axes.up;
}

Rgb point_color(const MapScenery& scenery, std::size_t i, double fade) {
  const PointCloud& cloud = scenery.map.cloud;
  Eigen::Vector3f color = Eigen::Vector3f::Constant(0.55F);
  if (cloud.has_colors()) {
    color = cloud.colors[i];
  } else if (cloud.has_normals()) {
    // Shading by a light from above and slightly from the side, so that floors and walls of both directions differ.
    const Eigen::Vector3d light =
        (2.0 * scenery.axes.up + scenery.axes.right + 0.5 * scenery.axes.forward).normalized();
    color.setConstant(static_cast<float>(0.4 + 0.45 * std::abs(light.dot(cloud.normals[i].cast<double>()))));
  }
  Rgb rgb;
  for (int c = 0; c < 3; ++c) {
    const float v = color[c];
    rgb[c] = static_cast<unsigned char>(std::lround(255.0F * (v > 0.0F ? std::min(v, 1.0F) : 0.0F)));
  }
  return toward_white(rgb, fade);
}

}  // namespace

MapScenery prepare_map(MapPoints map, const Trajectory& cameras, const Eigen::Vector3d& up, double cut_height) {
  check(map);
  MapScenery scenery;
  scenery.map = std::move(map);
  drop_broken(scenery.map);
  PointCloud& cloud = scenery.map.cloud;
  const std::vector<Eigen::Vector3d> positions = some_positions(cameras);
  if (!positions.empty() && !cloud.points.empty()) {
    if (cloud.has_normals()) {
      turn_normals(scenery.map, positions);
    } else {
      estimate_normals(cloud, neighbors, positions);
    }
    scenery.one_sided = true;
  }
  if (scenery.map.radii.empty() && !cloud.points.empty()) {
    scenery.map.radii = mean_neighbor_distances(cloud, 4);
    std::vector<double> spacing(scenery.map.radii.begin(), scenery.map.radii.end());
    // Outliers are far from all other points and would become large discs.
    const double largest = 2.0 * share_quantile(spacing, 0.5);
    for (float& radius : scenery.map.radii) radius = static_cast<float>(std::min<double>(0.8 * radius, largest));
  }
  scenery.axes = plan_axes(up.norm() > 0.0 ? up : estimate_up(cameras), cloud.points, cloud.normals);
  scenery.cut_height = std::isnan(cut_height) ? find_cut(scenery, positions) : cut_height;
  find_extent(scenery);
  return scenery;
}

FigureLayer map_layer(const MapScenery& scenery, const FigureView& view, double fade) {
  const Eigen::Vector3d center = scenery_center(scenery);
  const double scale = view.pixels_per_metre(center);
  const double least = scale > 0.0 ? 0.9 / scale : 0.0;
  const Eigen::Vector3d toward_viewer = -view.T_world_view.rotation_matrix().col(2);
  FigureLayer layer{FigureMesh(center), scenery.one_sided};
  const PointCloud& cloud = scenery.map.cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>();
    if (p.dot(scenery.axes.up) > scenery.cut_height) continue;
    const double radius = std::max<double>(scenery.map.radii[i], least);
    const double pixels = radius * scale;
    const int sides = pixels < 1.5 ? 4 : pixels < 4.0 ? 6 : pixels < 12.0 ? 8 : 16;
    Eigen::Vector3d normal = toward_viewer;
    if (cloud.has_normals() && cloud.normals[i].norm() > 0.5F) normal = cloud.normals[i].cast<double>().normalized();
    layer.mesh.add_disc(p, normal, radius, sides, point_color(scenery, i, fade));
  }
  return layer;
}

double open_azimuth(const MapScenery& scenery) {
  constexpr double turn = 0.45;  // [rad] angle to the walls' directions, so that two walls are visible
  double best = turn;
  std::size_t most = 0;
  for (int side = 0; side < 4; ++side) {
    for (const double offset : {turn, -turn}) {
      const double azimuth = side * std::numbers::pi / 2.0 + offset;
      const std::size_t shown = facing_extent(scenery, azimuth, 0.0).size();
      if (shown > most) {
        most = shown;
        best = azimuth;
      }
    }
  }
  return best;
}

std::vector<Eigen::Vector3d> facing_extent(const MapScenery& scenery, double azimuth, double elevation) {
  if (scenery.extent_normals.empty()) return scenery.extent;
  const Eigen::Vector3f sight = line_of_sight(scenery.axes, azimuth, elevation).cast<float>();
  std::vector<Eigen::Vector3d> facing;
  for (std::size_t i = 0; i < scenery.extent.size(); ++i) {
    if (scenery.extent_normals[i].dot(sight) < -0.05F) facing.push_back(scenery.extent[i]);
  }
  return facing.empty() ? scenery.extent : facing;
}

Eigen::Vector3d scenery_center(const MapScenery& scenery) {
  if (scenery.extent.empty()) return Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box;
  for (const auto& p : scenery.extent) box.extend(p);
  return box.center();
}

}  // namespace odosplat
