// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/trajectory.hpp"
#include "viewer/offscreen.hpp"

namespace odosplat {

/// A map as figures take it: flat discs. A point cloud has them at its points, Gaussians at their centres with the
/// direction of their smallest axis as normal and a radius of about one standard deviation.
struct MapPoints {
  PointCloud cloud;          // m, world; colours optional; normals optional, their sign does not matter
  std::vector<float> radii;  // [m] as many as points, or empty: from the spacing of the points
};

/// A map made ready to be drawn from outside and above like a doll's house: walls and ceilings are left out where one
/// would look at their backs, and all that is higher than the cut.
struct MapScenery {
  MapPoints map;  // normals towards the nearest camera; points that are not finite dropped
  PlanAxes axes;
  bool one_sided = false;                                       // the normals know their sides: backs are left out
  double cut_height = std::numeric_limits<double>::infinity();  // [m] along axes.up from the world's origin
  std::vector<Eigen::Vector3d> extent;          // points that a view of the map should hold: stray ones left out
  std::vector<Eigen::Vector3f> extent_normals;  // of those points; empty unless one_sided
};

/// Where to cut when the caller does not say.
inline constexpr double automatic_cut = std::numeric_limits<double>::quiet_NaN();

/// Sorts a map out for figures. `up` is the world's up (any length > 0); zero: estimate_up(cameras).
/// cut_height [m] along up: infinity for none; automatic_cut: a quarter of the cameras' height over the lowest points
/// above the highest camera, and none without cameras. Normals that are missing are estimated when there are cameras
/// to turn them to. An empty map stays empty. Throws InputError for radii, colours or normals that are not as many as
/// the points. Deterministic.
MapScenery prepare_map(MapPoints map, const Trajectory& cameras, const Eigen::Vector3d& up, double cut_height);

/// The map's discs for one view, at least about a pixel large; `fade` (0..1) takes colours to white, so that what
/// is drawn over the map stands out.
FigureLayer map_layer(const MapScenery& scenery, const FigureView& view, double fade);

/// The corner of the plan [rad, as view_from_corner takes it] from which most of the map shows its face.
double open_azimuth(const MapScenery& scenery);

/// Those points of the extent that show their face to such a view; all where the map has two sides.
std::vector<Eigen::Vector3d> facing_extent(const MapScenery& scenery, double azimuth, double elevation);

/// Middle of a scenery's extent; the origin if it has none.
Eigen::Vector3d scenery_center(const MapScenery& scenery);

}  // namespace odosplat
