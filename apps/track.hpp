// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "map_views.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalizer.hpp"
#include "sequence_flags.hpp"

namespace odosplat::apps {

struct TrackJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  std::string out;
  std::string start = "truth";  // or auto, or "tx ty tz qx qy qz qw"
  std::string frames;           // "A:B" that are tracked; empty: all
  bool relocalise = true;       // look lost frames up in the map
  std::string places;           // to look from; empty: where the map says it was seen from
  std::optional<bool> anchor;   // of the map's colours; none: as the method has it
  std::string depth_use;        // what the window makes of the map's depth; empty: as the method has it
  DepthNoiseFlags depth_noise;
  bool realtime = false;         // at the sequence's rate, late frames dropped
  std::uint64_t seed = 3141592;  // of the pixel selector and of depth noise
};

struct TrackOutcome {
  Trajectory trajectory;  // final estimate
  int frames = 0;         // tracked
  int dropped = 0;        // besides, in real time
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  int keyframes = 0;
  double median_ms = 0.0;
  double p95_ms = 0.0;
  double cpu_ms = 0.0;  // CPU time of all threads a frame, reading included
};

/// What lost frames are looked up by, and a start that is not known; null where neither is wanted, and for a depth
/// sensor, which has no places (InputError if it should start anywhere). map must outlive it.
std::unique_ptr<Relocalizer> make_relocalizer(const TrackJob& job, const Camera& camera, MapView& map, bool sensor);

/// How the odometry is set for this method and these flags.
OdometryOptions odometry_options(const TrackJob& job);

/// Tracks a sequence in a map and writes trajectory.txt, trajectory_live.txt, status.csv, covariance.csv and
/// report.json to the folder `out`. A frame whose files cannot be read is lost, for the reason in status.csv;
/// InputError if no frame can be read. The files are written every few seconds, and before an error is passed on, so
/// that a run that ends early leaves the frames so far. After Ctrl-C they hold the frames so far, and Interrupted is
/// thrown.
TrackOutcome track_sequence(const Common& common, const TrackJob& job);

}  // namespace odosplat::apps
