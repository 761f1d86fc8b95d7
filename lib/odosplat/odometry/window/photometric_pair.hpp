// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/keyframe/keyframe.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

struct PhotometricOptions {
  double noise = residual_noise;  // [grey] standard deviation of a residual
  double huber = residual_huber;  // [grey] residuals beyond weigh less
  double outlier =
      pattern_outlier;  // [grey] a point whose pattern differs more than this on average counts as occluded

  void check() const;
};

/// A keyframe's pose in an adjustment: where it is, and where derivatives are taken. The two are the same until a
/// marginal prior fixes the second (first-estimate Jacobians: Huang, Mourikis, Roumeliotis 2010).
struct PoseEstimate {
  SE3 T_world_camera;
  SE3 T_linearised;
  bool fixed = false;  // T_linearised differs
};

/// The quantities of a point that depend on its host alone, computed once for all targets.
struct HostPoint {
  Eigen::Vector3d ray;  // (x, y, 1) in the host's frame
  double q = 0.0;       // [1/m] inverse depth; not positive: no point there
  Eigen::Vector3f m;    // [1/m] slope of inverse depth over the pattern: the plane's, through the point
  double q_linearised;  // [1/m] as q, but like P, v and q_by_host at the host's linearised pose
  Eigen::Vector3d P;    // [m] the point in the world
  Eigen::Vector3d v;    // its ray, turned into the world
  Vector6d q_by_host;   // derivative of inverse depth by the host's pose: 0 for planes that move with it
};

/// The points of a host; offsets [1/m] takes the place of the points' own where it is not empty.
std::vector<HostPoint> make_host_points(std::span<const WindowPoint> points, std::span<const double> offsets,
                                        const Camera& camera, const PoseEstimate& host);

/// Points of one host seen in one target image.
struct PhotometricPair {
  std::span<const WindowPoint> points;
  std::span<const HostPoint> host_points;  // of the same points
  const GradientImage* target = nullptr;
  Camera camera;
  PoseEstimate host;
  PoseEstimate target_pose;
  Brightness host_brightness;
  Brightness target_brightness;
  double weight = 1.0;  // factor of all squared residuals
};

/// Quadratic model of a pair's cost at constant offsets. Order of the 16 parameters: host pose (6, left perturbation of
/// T_world_host), host a, b, target pose (6), target a, b. Residuals are divided by the noise: the Hessian is an
/// information matrix.
struct PairSystem {
  Eigen::Matrix<double, 16, 16> H = Eigen::Matrix<double, 16, 16>::Zero();
  Eigen::Matrix<double, 16, 1> g = Eigen::Matrix<double, 16, 1>::Zero();
  double cost = 0.0;  // half the robust sum of squares
  int inliers = 0;
  int outliers = 0;      // seen, but differing too much
  int outside = 0;       // not in view
  double squares = 0.0;  // [grey^2] mean squared residual of inliers, summed over inliers
};

/// What a pair adds to one estimated offset: its diagonal Hessian entry, its gradient, and the Hessian entries with the
/// 16 parameters.
struct DepthTerms {
  double H = 0.0;
  double g = 0.0;
  Eigen::Matrix<float, 16, 1> cross = Eigen::Matrix<float, 16, 1>::Zero();
  bool inlier = false;
  bool outlier = false;
};

/// Residuals r = I_target(p') - b_t - e^(a_t - a_h) (I_host(p) - b_h) over the 8-pixel pattern; the pattern is moved by
/// the plane's homography. With P the point, v its ray and q = q_plane + offset its inverse depth, moving the host is
///   dP = [I | -[P]x] xi_host - v / q^2 dq,  dq = q_plane / (D - N . t) N^T [I | -[P_plane]x] xi_host
/// (dq = 0 for planes that move with the host), and moving the target acts as -[I | -[P]x] xi_target. Weights:
/// gradient-dependent, Huber, and for offsets that are not estimated noise^2 / (noise^2 + (dr/dq sigma)^2) for the
/// map's uncertainty in depth. As in DSO, geometric derivatives are taken at the pattern's centre and at the linearised
/// poses, image gradients at the current place of each pixel. Points that differ too much cost a constant; points out
/// of view cost nothing. world may be any frame; precision is best near its origin. depth_terms: empty, or one per
/// point, of which those of estimated points are written. Sums run in single precision over 32 points, then in double.
/// Pure function.
PairSystem evaluate_pair(const PhotometricPair& pair, const PhotometricOptions& options,
                         std::span<DepthTerms> depth_terms = {});

}  // namespace odosplat
