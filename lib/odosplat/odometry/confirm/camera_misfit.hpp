// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "odosplat/odometry/confirm/map_confirmation.hpp"

namespace odosplat {

struct CameraMisfitOptions {
  // Standard deviations of what may be wrong before any image was seen.
  double focal_prior = 0.1;
  double center_prior = 0.05;
  double radial_prior = 0.2;
  int iterations = 5;      // on each of the two levels
  double min_patch = 0.3;  // correlation below which a square says nothing about where it should be
  /// Neighbouring pixels err alike, and a map is off by parts of a pixel for a whole view.
  double covariance_factor = 40.0;

  /// Throws InputError naming the field.
  void check() const;
};

/// Watches whether images fit the map as the camera says they should. A camera that is wrong leaves shifts between
/// image and map that no pose takes away: with the radius (focal length, distortion) or, where depth differs, the same
/// everywhere (principal point). Its errors are estimated from all keyframes together, and for each of them what pose
/// they have put it at. Source: Gauss-Newton steps on the squares' normalised grey values, pose and camera together;
/// the poses eliminated by Schur's complement. Not thread safe.
class CameraMisfit {
 public:
  explicit CameraMisfit(const CameraMisfitOptions& options);

  /// Takes a keyframe that the map confirms into account. Returns the effect on it of all that is known by then.
  MisfitEffect add(const ViewPatches& patches, const FramePyramid& image, const SE3& T_world_camera);

  CameraCorrection correction() const;
  /// Of the correction's vector.
  Eigen::Matrix4d covariance() const;
  /// What is probably wrong with the camera: "the images look as if the focal length were 4.8 % shorter"; empty where
  /// nothing stands out of its own doubt. camera: as it is said to be.
  std::string likely_cause(const Camera& camera) const;

 private:
  CameraMisfitOptions options_;
  Eigen::Matrix4d information_;
  Eigen::Vector4d vector_ = Eigen::Vector4d::Zero();
};

}  // namespace odosplat
