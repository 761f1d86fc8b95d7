// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "viewer/map_points.hpp"

namespace odosplat {

/// A time interval [s], both ends included.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};

/// Content of `view trajectory`: an estimated path over the lightened map, from above and in perspective, coloured by
/// its error, with the true path as a thin black line on it, the start, and dashes where tracking was lost.
struct TrajectoryFigure {
  cv::Size size{1600, 0};        // [px]; height 0: three quarters of the width
  MapPoints map;                 // may be empty
  Trajectory estimate;           // posed frames only, in the map's frame (already aligned, if at all)
  Trajectory truth;              // may be empty: no errors then
  std::optional<TimeSpan> span;  // of the images that should have poses; none: that of the truth
  std::vector<double> errors;    // [m], as many as the estimate, NaN = unknown; empty: distances from the truth
  double error_max = 0.0;        // [m] end of the colour scale; 0: the 99th percentile of the errors, rounded up
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  // of the world; zero: from the cameras
  double cut_height = automatic_cut;             // [m] along up; see prepare_map
  std::string title;                             // one line, such as "ATE RMSE 4.1 mm, max 9.8 mm"
};

/// Draws the figure: R, G, B, of the given size, on white. Panels are side by side on wide pages, otherwise one above
/// the other. Lost parts: the truth where the estimate has a gap of more than 2.5 times its median time step; without
/// truth a straight line over the gap. No data give empty panels, not an error. Same input, same bytes. Throws
/// InputError for an invalid size or arrays of different lengths, std::runtime_error if there is no OpenGL.
cv::Mat3b draw_trajectory(const TrajectoryFigure& figure);

/// Distance [m] of each estimated position from the true one of the same time, associated by associate() within
/// `tolerance` [s]; NaN if there is none.
std::vector<double> position_errors(const Trajectory& estimate, const Trajectory& truth, double tolerance = 0.01);

/// Time gap [s] above which frames count as lost: 2.5 times the median time step; infinite for fewer than two poses.
double longest_step(const Trajectory& estimate);

/// Paths of the parts where the estimate is missing, as described above; nothing outside the span counts as missing.
std::vector<std::vector<Eigen::Vector3d>> lost_stretches(const Trajectory& estimate, const Trajectory& truth,
                                                         const std::optional<TimeSpan>& span = {});

}  // namespace odosplat
