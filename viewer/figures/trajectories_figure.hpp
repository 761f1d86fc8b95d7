// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// An estimated path and the true one.
struct TrajectoryPanel {
  std::string words;                             // text above the panel: "icl_2: ATE 2.1 mm"
  Trajectory estimate;                           // T_world_camera, posed frames only; may be empty
  Trajectory truth;                              // T_world_camera; may be empty
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  // of the world; zero: from the cameras
};

/// Paths of several sequences in one picture (the paper's Figure 5), two panels per row.
struct TrajectoriesFigure {
  cv::Size size{1600, 0};  // [px]; height 0: as needed by the panels
  std::vector<TrajectoryPanel> panels;
};

/// Draws the figure: R, G, B, of the given size, on white. Each panel is a view straight down with its own scale bar:
/// the estimate is a broad coloured line, the truth a thin black line over it; a ring marks the start, dashes the parts
/// where tracking was lost (lost_stretches). An empty panel stays empty, no panels give a blank page. Same input, same
/// bytes. Needs no OpenGL. Any thread. Throws InputError for an invalid size.
cv::Mat3b draw_trajectories(const TrajectoriesFigure& figure);

}  // namespace odosplat
