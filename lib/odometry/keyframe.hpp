// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame.hpp"
#include "odosplat/odometry/map_plane.hpp"
#include "odosplat/odometry/tracking_reference.hpp"

namespace odosplat {

/// DSO's residual pattern: offsets [px] around a point; 8 pixels, so that two SIMD registers hold them.
inline constexpr int pattern_size = 8;
inline constexpr std::array<std::array<int, 2>, pattern_size> pattern = {
    {{0, -2}, {-1, -1}, {1, -1}, {-2, 0}, {0, 0}, {2, 0}, {-1, 1}, {0, 2}}};

/// A point of the window's adjustment: a pixel of its host with the world plane that the map shows there. The plane is
/// the map's and stays; where the pixel's ray meets it follows from the host's pose (reference: Ye, Huang, Liu 2020),
/// so that the map's geometry observes absolute pose.
struct WindowPoint {
  float u = 0.0F;  // [px]
  float v = 0.0F;
  Plane plane_world;
  Eigen::Vector3d m_host =
      Eigen::Vector3d::Zero();         // [1/m] the same plane m . p_host = 1 as rendered, were it fixed to the host
  double sigma = 0.0;                  // [1/m] of inverse depth
  float intensity[pattern_size] = {};  // [grey]
  float weight[pattern_size] = {};     // gradient-dependent, 0..1
};

/// The map's own view from a pose where a keyframe was believed to be: its image says what the keyframe should see from
/// exactly there. The pose is known and fixed: nothing estimated is in it. Empty without points.
struct MapAnchor {
  SE3 T_world_view;
  Brightness brightness;  // estimated: the map's exposure against the camera's
  std::vector<WindowPoint> points;
  double weight = 1.0;  // 0..1, smaller where the rendered image agrees badly with the real one
};

/// A frame that others are measured against. Data only.
struct Keyframe {
  int id = 0;         // counts keyframes from 0
  int frame = 0;      // counts images from 0
  double time = 0.0;  // [s]
  SE3 T_world_camera;
  Brightness brightness;
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera
  GradientImage gradient;                  // full size
  std::vector<WindowPoint> points;
  MapAnchor anchor;
  std::shared_ptr<const TrackingReference> reference;  // this image with the map's depth, for tracking later frames
};

}  // namespace odosplat
