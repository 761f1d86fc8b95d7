// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/confirm/camera_misfit.hpp"
#include "odosplat/odometry/odometry.hpp"

namespace odosplat::apps {

/// Estimates errors of the camera's calibration from images that were found in a map: one image alone says little about
/// the camera, as another pose makes up for much of an error. map must outlive this.
class CameraWatch {
 public:
  CameraWatch(const Camera& camera, MapView& map) : camera_(camera), map_(map), misfit_({}) {}

  /// Adds an image found at T_world_camera. Returns how its pose depends on the camera; undetermined where the
  /// map's colours do not confirm the pose.
  PoseByCamera add(const GrayImage& image, const SE3& T_world_camera);

  /// Why a pose is to be refused: with the camera that the images ask for, it would be more than
  /// OdometryOptions::max_misfit_translation or max_misfit_rotation off, or by an unknown amount. Empty: it stands. To
  /// be called once all images are added.
  std::string fault_of(const PoseByCamera& pose) const;

  /// What is probably wrong with the camera; empty: nothing significant.
  std::string likely_cause() const { return misfit_.likely_cause(camera_); }

 private:
  Camera camera_;
  MapView& map_;
  OdometryOptions options_;
  CameraMisfit misfit_;
};

}  // namespace odosplat::apps
