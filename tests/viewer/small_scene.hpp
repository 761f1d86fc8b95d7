// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cmath>
#include <numbers>

#include "odosplat/core/trajectory.hpp"
#include "viewer/map_points.hpp"

namespace odosplat {

/// A room of 4 x 3 x 2.5 m around the origin in a world with y down (up = -y); grey inside, with normals.
inline MapPoints grey_room(double spacing = 0.1) {
  MapPoints map;
  const Eigen::Vector3d half(2.0, 1.25, 1.5);
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    for (const double side : {-1.0, 1.0}) {
      for (double u = -half[a]; u <= half[a]; u += spacing) {
        for (double v = -half[b]; v <= half[b]; v += spacing) {
          Eigen::Vector3d p;
          p[axis] = side * half[axis];
          p[a] = u;
          p[b] = v;
          map.cloud.points.push_back(p.cast<float>());
          map.cloud.normals.push_back((-side * Eigen::Vector3d::Unit(axis)).cast<float>());
          map.cloud.colors.push_back(Eigen::Vector3f::Constant(0.5F));
        }
      }
    }
  }
  map.radii.assign(map.cloud.points.size(), static_cast<float>(0.7 * spacing));
  return map;
}

/// `count` level cameras in that world on a circle of radius 0.8 m, 30 per second, looking outward.
inline Trajectory circle(int count) {
  Trajectory cameras;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / std::max(count, 1);
    const Eigen::Vector3d z(std::cos(angle), 0.0, std::sin(angle));
    const Eigen::Vector3d y(0.0, 1.0, 0.0);
    Eigen::Matrix3d R_world_camera;
    R_world_camera << y.cross(z), y, z;
    cameras.push_back({k / 30.0, SE3(R_world_camera, 0.8 * z), ""});
  }
  return cameras;
}

}  // namespace odosplat
