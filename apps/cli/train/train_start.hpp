// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/quality/color_consistency.hpp"
#include "odosplat/splat/quality/map_quality.hpp"
#include "odosplat/splat/train/initialize.hpp"

namespace odosplat::apps {

/// All that training starts from, and what can be said of it before.
struct TrainingStart {
  PointCloud cloud;
  Gaussians start;
  std::unique_ptr<InterpolationView> surface;  // null where the preset has none
  double shared_sigma = 0.0;                   // [m]
  CloudCoverage coverage;
  double consistency = -1.0;  // ColorConsistency::Value::unexplained, negative: too few points in common to tell
  std::optional<GeometryDoubt> doubt;
};

/// Reads the cloud (read_cloud), compares it with the images and makes Gaussians of it; progress is shown, and Ctrl-C
/// ends the process at once. InputError if no image sees any of its points.
TrainingStart prepare_training(const std::string& file, double voxel, bool drop_outliers,
                               const InitializeOptions& initial, TrainingViews& views);

}  // namespace odosplat::apps
