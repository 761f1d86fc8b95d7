// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat::test {

/// A box room seen from inside, with smooth sine waves on its six walls. Depth and colour are exact at every pixel, so
/// that all errors are those of the odometry. Also a MapView.
class BoxRoom : public MapView {
 public:
  Eigen::Vector3d half_size{2.5, 1.6, 3.0};  // [m]
  double detail = 1.0;                       // factor of the texture's spatial frequency
  bool with_depth = true;
  bool with_color = true;
  double depth_factor = 1.0;  // factor on the rendered depth: a map of the wrong scale
  double gamma = 1.0;         // exponent of the rendered colours: a map with other colours
  double mapped_from = -1e9;  // [m] the map shows only surfaces with at least this x
  int renders = 0;

  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "box room"; }

  /// Grey value of the wall point [m], 0..1.
  double texture(const Eigen::Vector3d& p_world) const;
  /// Depth along the optical axis of the ray through the pixel [m].
  double depth(const Camera& camera, const SE3& T_world_camera, double u, double v) const;
  GrayImage gray(const Camera& camera, const SE3& T_world_camera) const;
  /// The image of a rolling shutter (camera.readout): each row as seen from the pose that the camera has then.
  /// T_world_camera: by the time since the middle row's [s].
  GrayImage gray(const Camera& camera, const std::function<SE3(double seconds)>& T_world_camera) const;
};

/// 160 x 120 with a horizontal field of view of 67 degrees.
Camera small_camera();

/// A smooth hand-held path through the room; pose number k of a 30 Hz camera, also between two of its images.
SE3 room_path(double k);

}  // namespace odosplat::test
