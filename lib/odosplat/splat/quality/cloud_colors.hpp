// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

/// Gives a cloud that has no colours (a lidar's) those of the images: for each point the mean over at most `most_views`
/// of the views, evenly spread, of the pixels in which it is seen, not hidden by nearer points. Points that no view
/// sees become grey. Uses all threads; deterministic. Frames: cloud and poses in one world frame [m].
void color_from_views(PointCloud& cloud, TrainingViews& views, int most_views = 60);

}  // namespace odosplat
