// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// From where and how a figure looks at the world. The viewer's own camera: x right, y down, z forward as every camera
/// here, pixel centres at integers, one focal length.
///   perspective: u = focal * x / z + cx      (focal in px)
///   parallel:    u = focal * x + cx          (focal in px per metre)
/// and v alike.
struct FigureView {
  SE3 T_world_view;
  cv::Size size;  // [px]
  double focal = 1.0;
  double cx = 0.0;  // [px]
  double cy = 0.0;  // [px]
  bool perspective = true;

  /// Pixel of a point; none behind a perspective view.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_world) const;
  /// Pixels a metre across the line of sight at p_world; 0 behind a perspective view.
  double pixels_per_metre(const Eigen::Vector3d& p_world) const;
};

/// A ground plan's axes: unit vectors of the world, right-handed (right x forward = up).
struct PlanAxes {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// World up from cameras held upright: minus the mean of their y axes, taken to the nearest world axis if that is
/// within 30 degrees (worlds mostly are levelled, cameras mostly look down a little). World z for no cameras or if the
/// mean vanishes.
Eigen::Vector3d estimate_up(const Trajectory& cameras);

/// Axes with the given up (any length > 0) whose right runs along the walls: the direction that most normals agree
/// on modulo 90 degrees, and of the two the one along which the points spread wider. Without normals: along the widest
/// spread of the points.
PlanAxes plan_axes(const Eigen::Vector3d& up, const std::vector<Eigen::Vector3f>& points,
                   const std::vector<Eigen::Vector3f>& normals);

/// Straight down on the plan, parallel, so that one scale holds everywhere: fits the points into the picture, `margin`
/// (share of the picture) left free on each side. No points: the metre around the world's origin.
FigureView view_from_above(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                           double margin);

/// In perspective from above at an angle: turned by `azimuth` from forward and down by `elevation` [rad], fits the
/// points as above.
FigureView view_from_corner(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                            double margin, double azimuth, double elevation);

}  // namespace odosplat
