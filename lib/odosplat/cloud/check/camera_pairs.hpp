// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "odosplat/camera/camera_correction.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// What the images say of the camera, and of time and scale of depth and poses: errors of what is declared.
struct CameraState {
  static constexpr int size = CameraCorrection::size + 2;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;
  /// Places in the vector.
  enum Place { at_focal, at_center_u, at_center_v, at_radial, at_readout, at_depth_factor, at_time_offset };
  CameraCorrection camera;
  double depth_factor = 0.0;  // natural logarithm of the factor by which depth would have to be multiplied
  double time_offset = 0.0;   // [s] the images were taken this long after the times of their poses

  /// The given camera with focal length and principal point corrected.
  Camera corrected(Camera given) const {
    given.cx += given.fx * camera.center_u;
    given.cy += given.fy * camera.center_v;
    given.fx *= 1.0 + camera.focal;
    given.fy *= 1.0 + camera.focal;
    return given;
  }

  Vector vector() const { return (Vector() << camera.vector(), depth_factor, time_offset).finished(); }
  static CameraState from(const Vector& v) {
    return {CameraCorrection::from(v.head<CameraCorrection::size>()), v[at_depth_factor], v[at_time_offset]};
  }
};

/// Colour images with depth and poses, of which camera and poses are to be checked against one another.
struct CameraFitInput {
  Camera camera;
  std::vector<double> times;                       // [s] one per image, ascending
  std::vector<std::optional<SE3>> T_world_camera;  // one per image; none: the image has no pose
  std::vector<bool> has_depth;                     // one per image
  std::function<GrayImage(std::size_t)> gray;      // of the camera's size
  /// Depth of an image [m], of the same size, 0 = none; empty if there is none after all. state: as far as it is known by
  /// now, for depth that is rendered from a map.
  std::function<DepthImage(std::size_t, const CameraState& state)> depth;
  std::function<void(double)> progress;  // called with the share of the work done; may be empty
};

/// Poses between the images' times, by interpolation.
class PosesOverTime {
 public:
  explicit PosesOverTime(const CameraFitInput& input);
  /// T_world_camera of an image's camera so many seconds after the image's time. Precondition: the image has a pose.
  SE3 at(std::size_t image, double seconds) const;

 private:
  Trajectory posed_;                // of the images with a pose
  std::vector<std::size_t> place_;  // of an image in posed_
};

/// Two images that see the same surfaces from different places.
struct CameraPair {
  std::size_t from = 0;
  std::size_t to = 0;
  SE3 T_to_given;  // correction of the relative pose: T_to_from = T_to_given * (as the poses say)
};

/// Pairs between whose images points at the depths of the first move by `motion` of the image's width or somewhat more
/// (median of a grid's points in view); evenly spaced first images with pose and depth, at most `wanted` pairs.
std::vector<CameraPair> camera_pairs(const CameraFitInput& input, const PosesOverTime& poses, const CameraState& state,
                                     double motion, int wanted);

/// Distance between the found and the expected position of a patch along a direction in which it has texture.
struct CameraEquation {
  Eigen::Matrix<double, 1, CameraState::size> by_state;
  Eigen::Matrix<double, 1, 6> by_pose;  // by a twist on the left of the pair's T_to_given
  double distance = 0.0;                // [px] found minus expected
};

/// Patches of the first image, on planes fitted to its depth, are searched in the second (match_patch); their expected
/// positions follow from state and pair. Empty if fewer than 40 patches, or less than a quarter of them, are found.
std::vector<CameraEquation> camera_equations(const CameraFitInput& input, const PosesOverTime& poses,
                                             const CameraState& state, const CameraPair& pair);

}  // namespace odosplat
