// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "apps/input/map_views.hpp"
#include "apps/input/sequence_flags.hpp"
#include "apps/input/training_frames.hpp"
#include "odosplat/eval/depth_metrics.hpp"

namespace odosplat::apps {

struct EvalDepthJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  DepthNoiseFlags depth_noise;
  std::string json;
  int every = 10;                     // step between judged frames
  int skip_every = skip_as_map_says;  // frames_not_trained_on
  std::string frames;                 // "A:B", empty: all
};

struct EvalDepthOutcome {
  DepthErrors all;
  DepthErrors selected;
  DepthErrors edges;
  double psnr_db = 0.0;  // NaN where the map has no colour
  double ssim = 0.0;
  int frames = 0;
};

/// Depth (and colour) of a map at true poses against the sequence's own, on frames the map was not made from.
EvalDepthOutcome evaluate_depth(const Common& common, const EvalDepthJob& job);

}  // namespace odosplat::apps
