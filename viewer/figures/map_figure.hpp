// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "viewer/map_points.hpp"

namespace odosplat {

/// Content of `view map`: the map obliquely from above, with the near walls and the ceiling left out, and the path of
/// the cameras with some of their frusta.
struct MapFigure {
  cv::Size size{1600, 0};  // [px]; height 0: three quarters of the width
  MapPoints map;
  Trajectory cameras;                            // T_world_camera; may be empty
  Camera camera;                                 // shape of the frusta; width 0: 4:3, 60 degrees horizontally
  int frusta = 20;                               // largest number of frusta drawn, >= 0
  double frustum_depth = 0.0;                    // [m]; 0: a twentieth of the picture's width
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  // of the world; zero: from the cameras
  double cut_height = automatic_cut;             // [m] along up; see prepare_map
  std::optional<FigureView> view;                // for the page below the title; none: chosen to show map and path
  std::string title;                             // one line; reduced in size, then cut if it does not fit
};

/// Draws the figure: R, G, B, of the given size, on white, with a scale bar (valid at the middle of the map) and the
/// world's axes. No map and no cameras give an empty scene, not an error. Same input, same bytes.
/// Throws InputError for an invalid size or map arrays of different lengths, std::runtime_error if there is no OpenGL.
cv::Mat3b draw_map(const MapFigure& figure);

/// Position of a world point in draw_map's picture, in pixels of the whole page with centres at integers; none if it is
/// behind the view.
std::optional<Eigen::Vector2d> locate_in_map_figure(const MapFigure& figure, const Eigen::Vector3d& p_world);

}  // namespace odosplat
