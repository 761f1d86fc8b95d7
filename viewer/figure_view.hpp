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

/// The viewer's camera: position, direction and projection of a figure. x right, y down, z forward, pixel centres at
/// integers, one focal length.
///   perspective: u = focal * x / z + cx      (focal in px)
///   parallel:    u = focal * x + cx          (focal in px per metre)
/// and v likewise.
struct FigureView {
  SE3 T_world_view;
  cv::Size size;  // [px]
  double focal = 1.0;
  double cx = 0.0;  // [px]
  double cy = 0.0;  // [px]
  bool perspective = true;

  /// Pixel of a point; none if it is behind a perspective view.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_world) const;
  /// Pixels per metre perpendicular to the line of sight at p_world; 0 if it is behind a perspective view.
  double pixels_per_metre(const Eigen::Vector3d& p_world) const;
};

/// Axes of a ground plan: unit vectors of the world, right-handed (right x forward = up).
struct PlanAxes {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// The world's up direction, from cameras held upright: the negative mean of their y axes, replaced by the nearest
/// world axis if that is within 30 degrees (most worlds are levelled, and most cameras look slightly down). World z if
/// there are no cameras or the mean vanishes.
Eigen::Vector3d estimate_up(const Trajectory& cameras);

/// Axes with the given up (any length > 0) whose right is along the walls: the direction on which most normals agree
/// modulo 90 degrees, and of the two such directions the one with the larger spread of the points. Without normals:
/// along the largest spread of the points.
PlanAxes plan_axes(const Eigen::Vector3d& up, const std::vector<Eigen::Vector3f>& points,
                   const std::vector<Eigen::Vector3f>& normals);

/// Parallel view straight down on the plan, so that one scale holds everywhere: fits the points into the picture and
/// leaves `margin` (share of the picture) free on each side. Without points: the metre around the world's origin.
FigureView view_from_above(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                           double margin);

/// Perspective view obliquely from above: turned by `azimuth` from forward and down by `elevation` [rad]; fits the
/// points as above.
FigureView view_from_corner(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                            double margin, double azimuth, double elevation);

}  // namespace odosplat
