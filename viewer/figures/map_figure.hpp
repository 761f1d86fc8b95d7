// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "viewer/map_points.hpp"

namespace odosplat {

/// What `view map` shows: the map from above at an angle, opened like a doll's house, with the path of the cameras
/// and some of their frusta.
struct MapFigure {
  cv::Size size{1600, 0};  // [px]; height 0: three quarters of the width
  MapPoints map;
  Trajectory cameras;                            // T_world_camera; may be empty
  Camera camera;                                 // shape of the frusta; width 0: 4:3 with 60 degrees across
  int frusta = 20;                               // most of the cameras that show theirs, >= 0
  double frustum_depth = 0.0;                    // [m]; 0: a twentieth of the picture's width
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  // of the world; zero: from the cameras
  double cut_height = automatic_cut;             // [m] along up; see prepare_map
  std::optional<FigureView> view;                // for the page under the title; none: chosen to hold map and path
  std::string title;                             // one line; shrunk, then cut where it does not fit
};

/// Draws the figure: R, G, B, of the size asked for, on white, with a scale bar (true at the middle of the map) and
/// the world's axes. No map and no cameras give an empty scene, not an error. Same input, same bytes.
/// Throws InputError for a bad size or map arrays of different lengths, std::runtime_error where there is no OpenGL.
cv::Mat3b draw_map(const MapFigure& figure);

/// Where draw_map puts a world point, in pixels of the whole page with centres at integers; none if it cannot be seen
/// from there.
std::optional<Eigen::Vector2d> locate_in_map_figure(const MapFigure& figure, const Eigen::Vector3d& p_world);

}  // namespace odosplat
