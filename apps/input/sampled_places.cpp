// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/sampled_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "odosplat/cloud/neighbor_search.hpp"

namespace odosplat::apps {
namespace {

/// The 2nd and the 98th percentile of a coordinate, so that outliers do not matter.
std::array<float, 2> extent(const std::vector<Eigen::Vector3f>& points, Eigen::Index axis) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const Eigen::Vector3f& p : points) values.push_back(p[axis]);
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 50;
  return {values[cut], values[values.size() - 1 - cut]};
}

}  // namespace

std::vector<SE3> sampled_places(const std::vector<Eigen::Vector3f>& points_world) {
  constexpr double step = 1.0;       // [m]
  constexpr double clearance = 0.3;  // [m]
  constexpr int directions = 12;
  constexpr std::size_t most = 1000;  // places
  std::vector<SE3> places;
  if (points_world.empty()) return places;
  std::array<std::array<float, 2>, 3> box{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) box[static_cast<std::size_t>(axis)] = extent(points_world, axis);
  const auto length = [&box](std::size_t axis) { return static_cast<double>(box[axis][1] - box[axis][0]); };
  std::size_t vertical = 1;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
    if (length(axis) < length(vertical)) vertical = axis;
  }
  const std::size_t side_a = (vertical + 1) % 3;
  const std::size_t side_b = (vertical + 2) % 3;
  const Eigen::Vector3d down =
      Eigen::Vector3d::Unit(static_cast<Eigen::Index>(vertical)) * (vertical == 1 ? 1.0 : -1.0);
  const NeighborSearch search(points_world);
  const auto steps = [&](std::size_t axis) { return std::max(1, static_cast<int>(std::lround(length(axis) / step))); };
  for (int a = 0; a < steps(side_a); ++a) {
    for (int b = 0; b < steps(side_b); ++b) {
      Eigen::Vector3d t;
      t[static_cast<Eigen::Index>(vertical)] = 0.5 * (box[vertical][0] + box[vertical][1]);
      t[static_cast<Eigen::Index>(side_a)] = box[side_a][0] + length(side_a) * (a + 0.5) / steps(side_a);
      t[static_cast<Eigen::Index>(side_b)] = box[side_b][0] + length(side_b) * (b + 0.5) / steps(side_b);
      int index = 0;
      float squared = 0.0F;
      if (search.nearest(t.cast<float>(), 1, &index, &squared) < 1 || squared < clearance * clearance) continue;
      for (int k = 0; k < directions && places.size() < most; ++k) {
        const Eigen::Vector3d level = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(side_a));
        const Eigen::Vector3d forward = so3_exp(down * (2.0 * std::numbers::pi * k / directions)) * level;
        Eigen::Matrix3d R_world_camera;
        R_world_camera << down.cross(forward), down, forward;
        places.emplace_back(R_world_camera, t);
      }
    }
  }
  return places;
}

std::vector<SE3> sampled_places(const Gaussians& gaussians) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    if (counts_as_surface(gaussians, i))
      points.emplace_back(Eigen::Map<const Eigen::Vector3f>(&gaussians.positions[3 * i]));
  }
  return sampled_places(points);
}

}  // namespace odosplat::apps
