// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/keyframe.hpp"

namespace odosplat {

struct PhotometricOptions {
  double noise = 5.0 / 255;     // [grey] standard deviation of a residual
  double huber = 9.0 / 255;     // [grey] residuals beyond weigh less
  double outlier = 14.0 / 255;  // [grey] a point whose pattern differs more than this on average counts as occluded

  bool planes_in_world = true;  // false: a point's depth stays what it was when its host was rendered

  void check() const;
};

/// Points of one host seen in one target image.
struct PhotometricPair {
  const std::vector<WindowPoint>* points = nullptr;
  const GradientImage* target = nullptr;
  Camera camera;
  SE3 T_world_host;
  SE3 T_world_target;
  Brightness host;
  Brightness target_brightness;
  double weight = 1.0;  // factor of all squared residuals
};

/// Quadratic model of a pair's cost. Order of the 16 parameters: host pose (6, left perturbation of T_world_host), host
/// a, b, target pose (6), target a, b. Residuals are divided by the noise: the Hessian is an information matrix.
struct PairSystem {
  Eigen::Matrix<double, 16, 16> H = Eigen::Matrix<double, 16, 16>::Zero();
  Eigen::Matrix<double, 16, 1> g = Eigen::Matrix<double, 16, 1>::Zero();
  double cost = 0.0;  // half the robust sum of squares
  int inliers = 0;
  int outliers = 0;      // seen, but differing too much
  int outside = 0;       // not in view
  double squares = 0.0;  // [grey^2] mean squared residual of inliers, summed over inliers
};

/// Residuals r = I_target(p') - b_t - e^(a_t - a_h) (I_host(p) - b_h) over the 8-pixel pattern; the pattern is moved by
/// the plane's homography. The point lies where the pixel's ray meets its world plane, so that moving the host moves
/// the ray along the plane: with P the point, v the ray and (N, D) the plane,
///   dP = (I - v N^T / (N . v)) [I | -[P]x] xi_host,
/// and moving the target acts as -[I | -[P]x] xi_target. Weights: gradient-dependent, Huber, and noise^2 / (noise^2 +
/// (dr/drho sigma_rho)^2) for the map's uncertainty in depth. As in DSO, geometric derivatives are taken at the
/// pattern's centre and image gradients at each pixel. Points that differ too much cost a constant; points out of view
/// cost nothing. world may be any frame; near its origin the numbers are best. Pure function.
PairSystem evaluate_pair(const PhotometricPair& pair, const PhotometricOptions& options);

}  // namespace odosplat
