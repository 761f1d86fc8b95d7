// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/cloud/check/camera_pairs.hpp"

namespace odosplat {

/// The equations of one pair, and the step of its relative pose.
struct PairPart {
  CameraPair pair;
  std::vector<CameraEquation> equations;
  Vector6d change = Vector6d::Zero();
};

/// Standard deviations along an axis of what the given relative poses of pairs are off.
struct PoseNoise {
  double meters = 0.0;
  double radians = 0.0;
};

struct CameraStep {
  CameraState::Vector value = CameraState::Vector::Zero();
  CameraState::Matrix covariance = CameraState::Matrix::Zero();
  PoseNoise noise;                           // 0.1 m, 0.1 rad: that much or more
  std::vector<CameraState::Vector> without;  // jackknife: the value without one group of neighbouring pairs each
};

/// Step of camera and pairs' poses that reduces the distances most, with the noise of the given relative poses that
/// makes the distances most likely. Source: least squares, reweighted with Tukey's function; the pairs' poses have a
/// normal prior about what was given and are eliminated by Schur's complement; their noise maximises the marginal
/// likelihood. prior: information on each unknown of the camera, centred on so_far = 0. The pairs' `change` is set.
CameraStep solve_camera(std::vector<PairPart>& parts, const CameraState::Vector& prior,
                        const CameraState::Vector& so_far);

/// Median distance [px] after a step of the camera and one of each pair's pose.
double median_distance(const std::vector<PairPart>& parts, const CameraState::Vector& state,
                       const std::vector<Vector6d>& poses);

}  // namespace odosplat
