// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/command/support.hpp"
#include "apps/input/public_options.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/splat/map_training.hpp"
#include "odosplat/splat/quality/map_quality.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"

namespace odosplat::apps {

class SequenceViews;

struct TrainJob {
  std::vector<std::string> sequences;  // all in one world frame
  SequenceOptions sequence_options;
  std::string cloud;
  double voxel = 0.0;            // [m] edge of the voxels that the cloud is thinned to; 0: not thinned
  bool remove_outliers = false;  // from the cloud
  std::string out;
  std::string report;  // JSON; empty: none
  int every = 10;
  std::string frames;  // "A:B", range in every sequence; empty: all
  std::string preset = "default";
  std::optional<int> iterations;  // none: the preset's
  std::uint64_t seed = 42;
  std::size_t budget = 0;              // largest number of Gaussians; 0: one per point
  std::string densify;                 // empty: the preset's
  std::string exposure;                // "on", "off"; empty: the preset's
  std::string blend_order;             // empty: the preset's; "depth" for .splat, which cannot store it
  std::optional<int> sh_degree;        // none: the preset's
  std::optional<double> depth_weight;  // none: the preset's
  int checkpoint_every = 500;          // iterations, 0: never
  bool resume = false;
  OptionValues options;  // of trainer and initialisation, applied after the preset's
};

struct TrainOutcome {
  TrainingReport training;
  MapQuality quality;
};

/// The preset's options with the job's changes. views: number of images.
TrainerOptions trainer_options(const TrainJob& job, int views);
InitializeOptions initialize_options(const TrainJob& job);

/// What the map's header says of the job and its frames.
TrainingFacts facts_of(const TrainJob& job, const SequenceViews& views);

/// Trains a map from a cloud and posed images, writes it to OUT, evaluates it, and writes the report if requested.
/// Checkpoints go to OUT.checkpoint, which is removed at the end; failing to write one is a warning, and the next one
/// is tried. After Ctrl-C a checkpoint is written, OUT is not changed, and Interrupted is thrown. InputError if no
/// image sees the cloud.
TrainOutcome run_training(const Common& common, const TrainJob& job);

}  // namespace odosplat::apps
