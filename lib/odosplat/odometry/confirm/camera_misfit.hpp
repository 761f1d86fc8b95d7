// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "odosplat/odometry/confirm/map_confirmation.hpp"

namespace odosplat {

struct CameraMisfitOptions {
  // Standard deviations of the calibration's errors before any image is compared.
  double focal_prior = 0.1;
  double center_prior = 0.05;
  double radial_prior = 0.2;
  int iterations = 5;      // on each of the two levels
  double min_patch = 0.3;  // correlation below which a square is not used
  /// Errors of neighbouring pixels are correlated, and a map is displaced by a fraction of a pixel over a whole view.
  double covariance_factor = 40.0;

  /// Throws InputError naming the field.
  void check() const;
};

/// Estimates errors of the camera's calibration from keyframes compared with the map. A wrong calibration leaves shifts
/// between image and map that no pose removes: growing with the radius (focal length, distortion) or, where depth
/// differs, the same everywhere (principal point). The errors are estimated from all keyframes together, and for each
/// keyframe their effect on its pose. Source: Gauss-Newton steps on the squares' normalised grey values, pose and
/// camera together; the poses eliminated by Schur's complement. Not thread safe.
class CameraMisfit {
 public:
  explicit CameraMisfit(const CameraMisfitOptions& options);

  /// Adds a keyframe that the map confirms. Returns the effect on its pose of the errors estimated up to then.
  MisfitEffect add(const ViewPatches& patches, const FramePyramid& image, const SE3& T_world_camera);

  CameraCorrection correction() const;
  /// Of the correction's vector.
  Eigen::Matrix4d covariance() const;
  /// What is probably wrong with the camera: "the images look as if the focal length were 4.8 % shorter"; empty if no
  /// error is significant. camera: with the given calibration.
  std::string likely_cause(const Camera& camera) const;

 private:
  CameraMisfitOptions options_;
  Eigen::Matrix4d information_;
  Eigen::Vector4d vector_ = Eigen::Vector4d::Zero();
};

}  // namespace odosplat
