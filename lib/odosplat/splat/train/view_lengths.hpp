// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

/// Largest distance of a camera from the mean of all [m]; 1 where all stand in one place.
double camera_extent(const TrainingViews& views);

/// Width of a pixel [m] at the distance of what the images show: the median over samples of Gaussians and images,
/// evenly spread, without regard to occlusion; 0 where no image sees any.
double pixel_width(const Gaussians& gaussians, const TrainingViews& views);

}  // namespace odosplat
