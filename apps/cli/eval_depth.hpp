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
  int every = 10;                     // step between evaluated frames
  int skip_every = skip_as_map_says;  // see frames_not_trained_on
  std::string frames;                 // "A:B", empty: all
};

struct EvalDepthOutcome {
  DepthErrors all;
  DepthErrors selected;
  DepthErrors edges;
  double psnr_db = 0.0;  // NaN if the map has no colour
  double ssim = 0.0;
  int frames = 0;
};

/// Compares a map's depth (and colour), rendered at true poses, with the sequence's images, on frames that the map was
/// not made from.
EvalDepthOutcome evaluate_depth(const Common& common, const EvalDepthJob& job);

}  // namespace odosplat::apps
