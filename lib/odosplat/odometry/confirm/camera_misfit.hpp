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
  double readout_prior = 0.03;  // [s]
  int iterations = 5;           // on each of the two levels
  double min_patch = 0.3;       // correlation below which a square is not used
  /// Errors of neighbouring pixels are correlated, and a map is displaced by a fraction of a pixel over a whole view.
  double covariance_factor = 40.0;

  /// Throws InputError naming the field.
  void check() const;
};

/// Estimates errors of the camera's calibration from keyframes compared with the map. A wrong calibration leaves shifts
/// between image and map that no pose removes: growing with the radius (focal length, distortion) or, where depth
/// differs, the same everywhere (principal point), or with the row while the camera moves (rolling shutter). The errors
/// are estimated from all images together, and for each image their effect on its pose. Source: Gauss-Newton steps on
/// the squares' normalised grey values, pose and camera together; the poses eliminated by Schur's complement. Not
/// thread safe.
class CameraMisfit {
 public:
  explicit CameraMisfit(const CameraMisfitOptions& options);

  /// Adds an image whose pose the map confirms. velocity: as in ViewPatches::misfit; 0 where it is unknown. Returns how
  /// its pose depends on the camera; undetermined where it could not be compared.
  PoseByCamera add(const ViewPatches& patches, const FramePyramid& image, const SE3& T_world_camera,
                   const Vector6d& velocity);

  /// Effect on a pose of the errors estimated up to now.
  MisfitEffect effect(const PoseByCamera& pose, const Camera& camera) const;

  CameraCorrection correction() const;
  /// Of the correction's vector.
  CameraCorrection::Matrix covariance() const;
  /// What is probably wrong with the camera: "the images look as if the focal length were 4.8 % shorter
  /// than in the camera file"; empty if no
  /// error is significant. camera: with the given calibration.
  std::string likely_cause(const Camera& camera) const;

 private:
  /// The error of the calibration that matters most.
  struct Largest {
    int number;     // in CameraCorrection::vector()
    double pixels;  // at half the image's width, or at its first and last rows in the fastest motion
    double sigmas;  // 0 if it is too small to matter
  };
  Largest largest(const Camera& camera) const;

  CameraMisfitOptions options_;
  CameraCorrection::Matrix information_;
  CameraCorrection::Vector vector_ = CameraCorrection::Vector::Zero();
  double flow_ = 0.0;  // [px/s] of the fastest keyframe
};

}  // namespace odosplat
