// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "map_views.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "sequence_flags.hpp"

namespace odosplat::apps {

struct TrackJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  std::string out;
  std::string start = "truth";  // or "tx ty tz qx qy qz qw"
  bool anchor = true;
  std::uint64_t seed = 3141592;
};

struct TrackOutcome {
  Trajectory trajectory;  // final estimate
  int frames = 0;
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  int keyframes = 0;
  double median_ms = 0.0;
  double p95_ms = 0.0;
};

/// How the odometry is set for this method and these flags.
OdometryOptions odometry_options(const TrackJob& job);

/// Tracks a sequence in a map and writes trajectory.txt, trajectory_live.txt, status.csv and report.json to the
/// folder `out`. After Ctrl-C the files hold the frames so far, and Interrupted is thrown.
TrackOutcome track_sequence(const Common& common, const TrackJob& job);

}  // namespace odosplat::apps
