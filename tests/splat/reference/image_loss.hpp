// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

namespace odosplat::reference {

/// Loss of the trainer in double precision, implemented from its definition: the full 11 x 11 window for every pixel,
/// not separated. Images are planar [3 x height x width].
struct ImageLossResult {
  double loss = 0.0;
  double l1 = 0.0;
  double mse = 0.0;
  double ssim = 0.0;
  std::vector<double> gradient;  // dloss / drendered [3 x height x width]
};

ImageLossResult image_loss(const std::vector<double>& rendered, const std::vector<double>& target, int width,
                           int height, double ssim_weight, bool squared);

}  // namespace odosplat::reference
