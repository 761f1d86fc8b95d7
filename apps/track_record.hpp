// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/sequence.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "track.hpp"

namespace odosplat::apps {

/// Everything that a run writes, gathered frame by frame.
class TrackRecord {
 public:
  void add(const Sequence& sequence, std::size_t i, const TrackResult& result);
  /// Frames that were never tracked: they are in no file but report.json, which counts them.
  void drop(std::size_t frames) { dropped_ += static_cast<int>(frames); }
  int dropped() const { return dropped_; }

  /// cpu_seconds: of the whole process, for reading, rendering and tracking.
  TrackOutcome outcome(const Odometry& odometry, double cpu_seconds) const;

  /// trajectory.txt, trajectory_live.txt, status.csv, covariance.csv and report.json, to the folder job.out.
  void write(const TrackJob& job, const TrackOutcome& outcome, const Odometry& odometry,
             const std::string& device) const;

 private:
  struct Row {
    double time;
    std::string stamp;
    TrackResult result;
  };

  std::string status_table(const std::vector<double>& keyframe_times) const;
  std::string covariance_table() const;

  std::vector<Row> rows_;
  int dropped_ = 0;
};

}  // namespace odosplat::apps
