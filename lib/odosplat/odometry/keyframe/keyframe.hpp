// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/confirm/map_confirmation.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"
#include "odosplat/odometry/points/immature_point.hpp"
#include "odosplat/odometry/points/map_plane.hpp"
#include "odosplat/odometry/points/residual_pattern.hpp"

namespace odosplat {

/// A point of the window's adjustment: a pixel of its host keyframe with an inverse depth, which is that of a plane on
/// the pixel's ray, plus `offset`. The plane is the map's and fixed in the world, so that moving the host moves the
/// point along the plane and the map's geometry constrains the absolute pose (Ye, Huang, Liu 2020); or it moves with
/// the host (`plane_in_world` false). The offset is 0, or an unknown of the adjustment (`estimated`), with a prior
/// around 0 or without one: for maps whose depth is not exact, and for points that the map does not show.
struct WindowPoint {
  float u = 0.0F;  // [px]
  float v = 0.0F;
  Plane plane_world;
  Eigen::Vector3d m_host = Eigen::Vector3d::Zero();  // [1/m] plane m . p_host = 1, for planes that move with the host
  double sigma = 0.0;                                // [1/m] of the plane's inverse depth, where nothing is estimated
  bool plane_in_world = true;
  bool estimated = false;
  bool of_map = true;                  // its depth comes from the map, however it is used; false: from motion alone
  double offset = 0.0;                 // [1/m]
  double prior_information = 0.0;      // [m^2] of the offset around 0, if estimated; 0: none
  int agreeing = 0;                    // keyframes in which it was seen and agreed, at the last adjustment
  int contradicting = 0;               // keyframes in which it was in view and differed too much
  float intensity[pattern_size] = {};  // [grey]
  float weight[pattern_size] = {};     // gradient-dependent, 0..1
};

/// Inverse depth [1/m] of the point for its host at T_world_host; not positive where there is none.
inline double inverse_depth(const WindowPoint& point, const Camera& camera, const SE3& T_world_host) {
  const Eigen::Vector3d ray = camera.ray(point.u, point.v);
  const Eigen::Vector3d m = point.plane_in_world ? plane_in_camera(point.plane_world, T_world_host) : point.m_host;
  return m.dot(ray) + point.offset;
}

/// A view whose pose is known and fixed, to which the window ties a keyframe: the map rendered from where the keyframe
/// was assumed to be, or an earlier keyframe that was itself aligned with the map.
struct Anchor {
  SE3 T_world_view;
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of it; the adjustment adds it to the keyframe's
  Brightness brightness;                   // estimated: the view's exposure against the camera's
  std::vector<WindowPoint> points;
  double weight = 1.0;  // factor of all its squared residuals
};

/// A frame that others are measured against. Data only.
struct Keyframe {
  int id = 0;         // counts keyframes from 0
  int frame = 0;      // counts images from 0
  double time = 0.0;  // [s]
  SE3 T_world_camera;
  /// Its pose by tracking and by alignment with the map, before the window was adjusted: centre of a weak prior.
  std::optional<SE3> T_world_tracked;
  Brightness brightness;
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera, as the window knows it
  int outside = 0;                         // keyframes since the map was left; 0 in it
  GradientImage gradient;                  // full size
  std::vector<WindowPoint> points;
  std::vector<ImmaturePoint> immature;
  std::vector<Anchor> anchors;
  std::shared_ptr<const TrackingReference> reference;  // this image with the map's depth, for tracking later frames
  std::shared_ptr<const ViewPatches> patches;  // of the map, rendered from about here, to confirm poses with; null: no
                                               // colours
  bool in_map = false;                         // its depth is the map's
  MisfitEffect misfit;                         // effect of errors of the camera's calibration on its pose
};

}  // namespace odosplat
