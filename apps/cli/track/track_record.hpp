// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/track/duration_samples.hpp"
#include "apps/cli/track/frame_source.hpp"
#include "apps/cli/track/track_job.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/odometry/odometry.hpp"

namespace odosplat::apps {

/// What the odometry knows of a run so far.
struct OdometryResults {
  Trajectory trajectory;               // final estimate
  std::vector<double> keyframe_times;  // [s]
  OdometryStatistics statistics;
};
OdometryResults results_of(const Odometry& odometry);

/// Facts of a run for report.json that are not those of its frames.
struct TrackFacts {
  std::string device;
  double cpu_seconds = 0.0;       // of the whole process, including reading and rendering
  bool finished = false;          // no more frames follow
  nlohmann::ordered_json live;    // of live sources: put at the top level; null: none
  nlohmann::ordered_json stream;  // of --stream; null: none
};

/// Collects the results of a run frame by frame and writes its files. About 0.7 kB a frame are kept until take_out().
class TrackRecord {
 public:
  /// latency_ms: from the image's arrival until its pose was known; none: the source is not live.
  void add(const InputFrame& frame, const TrackResult& result, std::optional<double> latency_ms);
  /// Adds a frame that cannot be read: it counts as lost because of its fault. The first one is logged.
  void add_unreadable(const InputFrame& frame);
  std::size_t unreadable() const { return unreadable_; }
  /// Reason of the first unreadable frame.
  const std::string& first_fault() const { return first_fault_; }
  /// Number of frames tracked.
  std::size_t tracked() const { return tracked_; }
  /// Number of frames that are kept.
  std::size_t kept() const { return rows_.size(); }
  /// Counts frames that were never tracked: they appear only as a count in report.json.
  void drop(std::size_t frames) { dropped_ += static_cast<int>(frames); }
  int dropped() const { return dropped_; }

  TrackOutcome outcome(const OdometryResults& results, double cpu_seconds) const;

  /// Writes trajectory.txt, trajectory_live.txt, status.csv, covariance.csv and report.json to the folder job.out.
  void write(const TrackJob& job, const OdometryResults& results, const TrackFacts& facts) const;

  /// The oldest frames kept, as a record of their own. counts and durations stay.
  TrackRecord take_out(std::size_t frames);
  /// Time of the oldest frame kept [s]. Precondition: kept() > 0.
  double first_time() const { return rows_.front().time; }
  /// Writes the files above, except report.json, with the poses of results.trajectory that belong to the frames kept.
  void write_tables(const std::string& folder, const OdometryResults& results, Durability durability) const;

 private:
  struct Row {
    double time;
    std::string stamp;
    TrackResult result;
    std::optional<double> latency_ms;
    std::string reason;  // why the frame cannot be read; empty: it was tracked
  };

  Trajectory stamped(const Trajectory& trajectory) const;
  std::string status_table(const std::vector<double>& keyframe_times) const;
  std::string covariance_table() const;
  nlohmann::ordered_json report(const TrackJob& job, const OdometryResults& results, const TrackFacts& facts) const;

  std::vector<Row> rows_;
  DurationSamples tracking_ms_;
  DurationSamples latency_ms_;
  std::size_t tracked_ = 0;
  std::size_t unreadable_ = 0;
  std::string first_fault_;
  int dropped_ = 0;
};

}  // namespace odosplat::apps
