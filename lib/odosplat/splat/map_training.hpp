// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/splat/map.hpp"
#include "odosplat/splat/quality/color_consistency.hpp"
#include "odosplat/splat/quality/map_quality.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"

namespace odosplat {

/// Called with a few words when a stage of long work begins ("smoothing the cloud"); may be empty.
using StageNotice = std::function<void(const std::string& stage)>;

/// All that training starts from, and what is known of its quality before.
struct TrainingStart {
  PointCloud cloud;
  Gaussians gaussians;
  std::unique_ptr<InterpolationView> surface;  // null where the initial shape has none
  double shared_sigma = 0.0;                   // [m]
  CloudCoverage coverage;
  double consistency = -1.0;  // ColorConsistency::Value::unexplained, negative: too few points in common
  std::optional<GeometryDoubt> doubt;
};

/// Compares the cloud with the images and makes Gaussians of it; a cloud without colours takes them from the images.
/// InputError(name, fault) if no image sees any of its points. At most 6 stages.
TrainingStart prepare_training(PointCloud cloud, const std::string& name, const InitializeOptions& options,
                               TrainingViews& views, const StageNotice& stage = {});

/// A map, how it compares with each training image, and the report of its training.
struct TrainedMap {
  Map map;
  std::vector<ViewQuality> views;
  TrainingReport training;
};

/// What is known of a training besides its result.
struct TrainingFacts {
  int usual_iterations = 0;        // of the preset, to report that a training was short
  std::size_t budget = 0;          // most Gaussians that the user asked for, 0: no such limit
  std::vector<std::string> notes;  // more lines for the header
};

/// Compares the trained map with its images, calibrates the uncertainty of its depth, and writes both, the settings and
/// the places of the images into the map's header. At most 2 stages.
TrainedMap finish_training(const compute::Context& context, const Trainer& trainer, const TrainingStart& start,
                           TrainingViews& views, const TrainingFacts& facts, const StageNotice& stage = {});

/// A map from a cloud [m, world] and posed images of it, as `odosplat train` makes it with that preset ("default" or
/// "paper") and no other flags: prepare_training, all steps of a Trainer, finish_training. The header does not name the
/// training frames, which the views do not know. Blocks; the same bits for the same seed, input and device. Errors:
/// those of the three.
TrainedMap train_map(const compute::Context& context, PointCloud cloud, TrainingViews& views,
                     const std::string& preset = "default");
/// The same with options of one's own; the verdict takes their number of steps for the usual one.
TrainedMap train_map(const compute::Context& context, PointCloud cloud, TrainingViews& views,
                     const InitializeOptions& initial, const TrainerOptions& options);

}  // namespace odosplat
