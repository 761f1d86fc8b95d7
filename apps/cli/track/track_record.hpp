// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/cli/track/track_job.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/odometry/odometry.hpp"

namespace odosplat::apps {

/// Collects the results of a run frame by frame and writes its files.
class TrackRecord {
 public:
  void add(const Sequence& sequence, std::size_t i, const TrackResult& result);
  /// Adds a frame whose files cannot be read: it counts as lost for this reason. The first one is logged.
  void add_unreadable(const Sequence& sequence, std::size_t i, const std::string& reason);
  std::size_t unreadable() const { return unreadable_; }
  /// Reason of the first unreadable frame.
  const std::string& first_fault() const { return first_fault_; }
  /// Number of frames tracked.
  std::size_t tracked() const { return rows_.size() - unreadable_; }
  /// Counts frames that were never tracked: they appear only as a count in report.json.
  void drop(std::size_t frames) { dropped_ += static_cast<int>(frames); }
  int dropped() const { return dropped_; }

  /// cpu_seconds: of the whole process, including reading and rendering.
  TrackOutcome outcome(const Odometry& odometry, double cpu_seconds) const;

  /// Writes trajectory.txt, trajectory_live.txt, status.csv, covariance.csv and report.json to the folder job.out.
  /// finished: no more frames follow.
  void write(const TrackJob& job, const TrackOutcome& outcome, const Odometry& odometry, const std::string& device,
             bool finished) const;

 private:
  struct Row {
    double time;
    std::string stamp;
    TrackResult result;
    std::string reason;  // why the frame cannot be read; empty: it was tracked
  };

  std::string status_table(const std::vector<double>& keyframe_times) const;
  std::string covariance_table() const;

  std::vector<Row> rows_;
  std::size_t unreadable_ = 0;
  std::string first_fault_;
  int dropped_ = 0;
};

}  // namespace odosplat::apps
