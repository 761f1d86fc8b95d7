// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

/// The noise model of photometric residuals, of which the parts of the odometry take their defaults. Grey values are
/// 0..1; the values are those of 8-bit images, and contain interpolation and what a map renders imperfectly.
namespace odosplat {

/// [grey] Standard deviation of a residual.
inline constexpr double residual_noise = 5.0 / 255;
/// [grey] Residuals beyond weigh less (Huber): 1.8 standard deviations, and 9 of 255 as in DSO.
inline constexpr double residual_huber = 9.0 / 255;
/// [grey] Largest mean residual over a point's pattern at which it still counts as seen.
inline constexpr double pattern_outlier = 14.0 / 255;
/// [grey/px] c of the weight c^2 / (c^2 + |gradient|^2), by which strong gradients, whose residuals suffer most from
/// small errors of position, weigh less (DSO).
inline constexpr double gradient_weight_constant = 50.0 / 255;

}  // namespace odosplat
