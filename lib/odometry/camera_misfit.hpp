// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "odosplat/odometry/map_confirmation.hpp"

namespace odosplat {

/// What may be wrong with the camera that images are said to be of, as seen from the map: with x and y a point's ray at
/// depth 1 and r^2 = x^2 + y^2, u = fx ((1 + focal) x (1 + radial r^2) + center_u) + cx, v likewise.
struct CameraCorrection {
  static constexpr int size = 4;
  double focal = 0.0;
  double center_u = 0.0;
  double center_v = 0.0;
  double radial = 0.0;

  Eigen::Vector4d vector() const { return {focal, center_u, center_v, radial}; }
  static CameraCorrection from(const Eigen::Vector4d& v) { return {v[0], v[1], v[2], v[3]}; }
};

/// Normal equations of one image's remaining shifts against the map: of the pose (twist on the left of T_camera_world,
/// rows 0 to 5) and of the camera (rows 6 to 9). Solution: right values less those that the residuals were taken at.
struct MisfitSystem {
  Eigen::Matrix<double, 10, 10> information = Eigen::Matrix<double, 10, 10>::Zero();
  Eigen::Matrix<double, 10, 1> vector = Eigen::Matrix<double, 10, 1>::Zero();
  double noise = 0.0;  // variance of one residual, of normalised grey values
  int patches = 0;
};

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
