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
#include "odosplat/splat/quality/map_quality.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer.hpp"

namespace odosplat::apps {

struct TrainJob {
  std::vector<std::string> sequences;  // in one world frame
  SequenceOptions sequence_options;
  std::string cloud;
  double voxel = 0.0;            // [m] edge of the voxels that thin the cloud; 0: as it is
  bool remove_outliers = false;  // of the cloud
  std::string out;
  std::string report;  // JSON; empty: none
  int every = 10;
  std::string frames;  // "A:B" of every sequence; empty: all
  std::string preset = "default";
  std::optional<int> iterations;  // none: the preset's
  std::uint64_t seed = 42;
  std::size_t budget = 0;              // Gaussians, 0: one a point
  std::string densify;                 // empty: the preset's
  std::string exposure;                // on, off; empty: the preset's
  std::string blend_order;             // empty: the preset's; depth for a .splat, which cannot say otherwise
  std::optional<int> sh_degree;        // none: the preset's
  std::optional<double> depth_weight;  // none: the preset's
  int checkpoint_every = 500;          // iterations, 0: never
  bool resume = false;
  OptionValues options;  // of trainer and start, upon the preset's
};

struct TrainOutcome {
  TrainingReport training;
  MapQuality quality;
};

/// Makes map.ply from a cloud and posed images, judges it, and writes the report if asked. Checkpoints go to
/// OUT.checkpoint, which is removed at the end; one that cannot be written is a warning, and tried again. After Ctrl-C
/// a checkpoint is written, OUT stays as it was, and Interrupted is thrown. InputError if no image sees the cloud.
TrainOutcome run_training(const Common& common, const TrainJob& job);

}  // namespace odosplat::apps
