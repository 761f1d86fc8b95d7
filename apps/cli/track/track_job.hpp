// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/input/map_views.hpp"
#include "apps/input/public_options.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat::apps {

struct TrackJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  std::string out;
  std::string start = "truth";  // "truth", "auto", or "tx ty tz qx qy qz qw"
  std::string frames;           // "A:B", range that is tracked; empty: all
  bool relocalise = true;       // look lost frames up in the map
  std::string places;           // trajectory of poses to look from; empty: those in the map's header
  std::optional<bool> anchor;   // align keyframes with the map's rendered colours; none: the method's default
  std::string depth_use;        // how the window uses the map's depth (DepthUse); empty: the method's default
  DepthNoiseFlags depth_noise;
  bool realtime = false;         // at the sequence's rate, late frames dropped
  std::uint64_t seed = 3141592;  // of the pixel selector and of depth noise
  OptionValues options;          // of odometry and relocaliser, applied after the method's
};

struct TrackOutcome {
  Trajectory trajectory;  // final estimate
  int frames = 0;         // tracked
  int dropped = 0;        // in real time, in addition to `frames`
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  int keyframes = 0;
  double median_ms = 0.0;
  double p95_ms = 0.0;
  double cpu_ms = 0.0;  // CPU time of all threads per frame, including reading
};

}  // namespace odosplat::apps
