// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/trajectory.hpp"
#include "viewer/offscreen.hpp"

namespace odosplat {

/// A map as oriented discs, for drawing. Those of a point cloud are at its points, those of Gaussians at their centres,
/// with the direction of the smallest axis as normal and a radius of about one standard deviation.
struct MapPoints {
  PointCloud cloud;          // m, world; colours optional; normals optional, their sign does not matter
  std::vector<float> radii;  // [m] one for each point, or empty: from the spacing of the points
};

/// A map prepared for drawing from outside and above: walls and ceilings seen from behind are left out, and everything
/// above the cut.
struct MapScenery {
  MapPoints map;  // normals towards the nearest camera; without points that are not finite
  PlanAxes axes;
  bool one_sided = false;                                       // normals have a known side: back faces are left out
  double cut_height = std::numeric_limits<double>::infinity();  // [m] along axes.up from the world's origin
  std::vector<Eigen::Vector3d> extent;          // points that a view of the map should contain, without outliers
  std::vector<Eigen::Vector3f> extent_normals;  // of those points; empty unless one_sided
};

/// Value of cut_height to choose the cut automatically.
inline constexpr double automatic_cut = std::numeric_limits<double>::quiet_NaN();

/// Prepares a map for drawing. `up` is the world's up (any length > 0); zero: estimate_up(cameras).
/// cut_height [m] along up: infinity for none; automatic_cut: above the highest camera by a quarter of its height over
/// the
/// lowest points, and none without cameras. Missing normals are estimated if there are cameras to orient them. An empty
/// map stays empty. Throws InputError if the numbers of radii, colours or normals differ from that of the points.
/// Deterministic.
MapScenery prepare_map(MapPoints map, const Trajectory& cameras, const Eigen::Vector3d& up, double cut_height);

/// The map's discs for one view, each at least about a pixel large. `fade` (0..1) mixes colours with white, so that
/// paths drawn over the map stand out.
FigureLayer map_layer(const MapScenery& scenery, const FigureView& view, double fade);

/// Azimuth [rad, as for view_from_corner] from which most of the map is seen from its front.
double open_azimuth(const MapScenery& scenery);

/// Points of the extent whose front is visible from such a view; all if the normals' orientation is unknown.
std::vector<Eigen::Vector3d> facing_extent(const MapScenery& scenery, double azimuth, double elevation);

/// Centre of a scenery's extent; the origin if it is empty.
Eigen::Vector3d scenery_center(const MapScenery& scenery);

}  // namespace odosplat
