// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/light/brightness_splines.hpp"

namespace odosplat {

struct ResidualWeightOptions {
  int columns = 20;             // of square blocks over the image's width
  double noise = 1.5 / 255;     // [grey] root mean square residual of a block up to which its points have full weight
  double outlier = 40.0 / 255;  // [grey] residuals count as at most this
  double prior = 4.0;           // number of points with that noise that are added to every block

  void check() const;
};

/// Weight 0..1 of each block of a reference's image.
struct ResidualWeights {
  double block = 1.0;  // [px]
  int columns = 0;
  int rows = 0;
  std::vector<double> weight;  // row after row

  /// u, v: pixel of the reference, full size.
  double at(double u, double v) const;
};

/// How well a reference and the image that was aligned with it agree, block by block: inverse variance of the residuals
/// of a block's points. A map's errors are regional: relief finer than its cloud, surfaces that few images saw. camera:
/// the reference's, full size; samples: of its level 0. Pure function.
ResidualWeights residual_weights(const Camera& camera, const std::vector<BrightnessSample>& samples,
                                 const ResidualWeightOptions& options);

}  // namespace odosplat
