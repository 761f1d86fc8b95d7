// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/input/map_views.hpp"
#include "apps/input/public_options.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat::apps {

/// Flags for live sources; none: the default.
struct LiveFlags {
  std::optional<double> reconnect;         // [s] LiveOptions::reconnect
  std::optional<double> open_timeout;      // [s] LiveOptions::open_timeout
  std::optional<std::size_t> part_frames;  // frames after which results are put aside (PartFolders)
};

struct TrackJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  std::string out;
  std::string start;           // "truth", "auto", or "tx ty tz qx qy qz qw"; empty: truth, of live sources auto
  std::string frames;          // "A:B", range that is tracked; empty: all
  bool relocalise = true;      // look lost frames up in the map
  std::string places;          // trajectory of poses to look from; empty: those in the map's header
  std::optional<bool> anchor;  // align keyframes with the map's rendered colours; none: the method's default
  std::string depth_use;       // how the window uses the map's depth (DepthUse); empty: the method's default
  DepthNoiseFlags depth_noise;
  bool realtime = false;  // at the sequence's rate, late frames dropped; live sources always are
  LiveFlags live;
  std::string stream;            // where a line per frame goes: "-", "udp://HOST:PORT"; empty: nowhere
  std::uint64_t seed = 3141592;  // of the pixel selector and of depth noise
  OptionValues options;          // of odometry and relocaliser, applied after the method's

  bool live_source = false;  // sequence.path is one; asked once, as a camera may be unplugged later

  bool is_live() const { return live_source; }
  bool finds_start() const { return start == "auto" || (start.empty() && is_live()); }
  bool in_real_time() const { return realtime || is_live(); }
};

/// [ms] From the arrival of a live source's image until its pose is known.
struct Latency {
  double median = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double most = 0.0;
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
  Latency latency_ms;   // of live sources
  double cpu_ms = 0.0;  // CPU time of all threads per frame, including reading
};

}  // namespace odosplat::apps
