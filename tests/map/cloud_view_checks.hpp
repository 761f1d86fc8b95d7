// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cmath>
#include <limits>

#include "odosplat/core/point_cloud.hpp"
#include "tests/map/map_view_checks.hpp"

namespace odosplat {

/// Shared by the tests of views of a point cloud.

inline const Camera camera_320{320, 240, 240.0, 240.0, 159.5, 119.5};

/// A plane n . p = d in the world.
struct Plane {
  Eigen::Vector3d n;
  double d;
  double depth(const Camera& camera, const SE3& T_world_camera, double u, double v) const {
    const Eigen::Vector3d ray = T_world_camera.rotation() * camera.ray(u, v);
    return (d - n.dot(T_world_camera.translation())) / n.dot(ray);
  }
};

/// Runs the checks of every MapView for a cloud, seen from the origin and from so close that a few points fill the
/// view.
template <typename View>
void check_cloud_view(const PointCloud& cloud) {
  View view(cloud);
  check_map_view(view, Camera{163, 121, 120.0, 121.0, 80.0, 60.5}, SE3());
  check_map_view_sizes(view, camera_320, SE3());
  const Eigen::Vector3d close = cloud.points[cloud.size() / 2].template cast<double>() - 0.1 * Eigen::Vector3d::UnitZ();
  check_map_view(view, camera_320, SE3(Eigen::Quaterniond::Identity(), close));
}

/// Checks clouds without points, without points in view, without finite points, and with all points in one place.
template <typename View>
void check_views_of_poor_clouds() {
  View empty(PointCloud{});
  check_empty_map_view(empty, camera_320, SE3());
  PointCloud behind;
  behind.points.assign(5, Eigen::Vector3f(0, 0, -2));
  View nothing_in_view(behind);
  check_empty_map_view(nothing_in_view, camera_320, SE3());
  PointCloud bad;
  bad.points = {{std::nanf(""), 0, 1}, {0, 0, std::numeric_limits<float>::infinity()}};
  View not_finite(bad);
  check_empty_map_view(not_finite, camera_320, SE3());
  PointCloud same;
  same.points.assign(20, Eigen::Vector3f(0, 0, 2));  // spacing 0
  View copies(same);
  expect_well_formed(copies.render(camera_320, SE3(), {}), camera_320, {});
}

}  // namespace odosplat
