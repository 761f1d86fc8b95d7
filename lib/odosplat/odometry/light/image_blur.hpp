// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/light/brightness_splines.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

struct BlurOptions {
  bool enabled = true;
  double huber = residual_huber;  // [grey] residuals beyond weigh less
  // [px^2] of the larger variance, below which a blur is ignored. Sharp images of the camera that the map was made with
  // reach 0.3 at most, a blur over 5 px 0.6 to 1.2 at the first step.
  double least = 0.5;
  double most = 16.0;  // [px^2] of a variance
  // Cost with a blur over the cost without, above which the blur is rejected. A blur over 5 px reaches 0.85 to 0.98
  // where the map's own errors are larger (docs/rules.md).
  double explained = 0.97;

  void check() const;
};

/// The blur of the target against its reference, from motion of the camera or from defocus, neither of which a rendered
/// image has: covariance [px^2] of the kernel. host: gradients of the reference's image; samples: of level 0. To second
/// order, an image with a kernel of covariance C differs by tr(C H) / 2, with H the second derivatives; fitted robustly
/// together with a small change of the alignment. None if no blur is found. Pure function.
std::optional<Eigen::Matrix2d> estimate_blur(const GradientImage& host, const std::vector<BrightnessSample>& samples,
                                             double gain, const BlurOptions& options);

/// The image convolved with a Gaussian of that covariance [px^2], which must not have negative eigenvalues.
GrayImage apply_blur(const GrayImage& image, const Eigen::Matrix2d& covariance);

}  // namespace odosplat
