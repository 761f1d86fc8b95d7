// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <future>
#include <optional>
#include <string>

#include "apps/cli/track/frame_source.hpp"
#include "apps/cli/track/pose_stream.hpp"
#include "apps/cli/track/track_job.hpp"
#include "apps/cli/track/track_record.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/odometry/odometry.hpp"

namespace odosplat::apps {

/// The loop of a run: frame after frame from the source through the odometry into the record, the stream of poses and,
/// every few seconds, the files.
/// In real time the files are written on another thread, from a copy of the record. A live run puts its results aside in
/// parts (folders part-000001, ... in the output folder), so that memory and time for writing do not grow with its length.
class TrackRun {
 public:
  /// device: for the report. stream: null for none. All must outlive this.
  TrackRun(const TrackJob& job, FrameSource& source, Odometry& odometry, TrackRecord& record, const std::string& device,
           PoseStream* stream);

  /// Tracks until the source ends. False after Ctrl-C.
  bool play();

  /// Writes the results so far; finished: they are complete.
  TrackOutcome write(bool finished);

 private:
  void track(const InputFrame& frame);
  void report_progress(const InputFrame& frame, TrackStatus status);
  TrackFacts facts(bool finished) const;
  void write_now_and_then();
  void note_written(bool ok, double seconds);
  void put_aside();

  const TrackJob& job_;
  FrameSource& source_;
  Odometry& odometry_;
  TrackRecord& record_;
  const std::string device_;
  PoseStream* stream_;
  Progress progress_;
  long done_ = 0;  // frames, dropped ones included
  bool warned_of_camera_ = false;
  const double cpu_before_ = cpu_seconds();
  const std::optional<std::size_t> part_frames_;  // none: the results are not put aside
  /// Results that have left the record.
  struct Part {
    std::shared_ptr<const TrackRecord> record;
    std::shared_ptr<const OdometryResults> results;
    std::string folder;
  };
  bool part_is_written();
  void write_part();

  std::size_t parts_ = 0;
  std::optional<Part> part_;        // not written yet
  std::future<bool> writing_part_;  // whether it could be written
  struct Written {
    bool ok;
    double seconds;
  };
  std::future<Written> writing_;
  Stopwatch since_write_;
  double next_write_ = 5.0;  // [s] between two writes
  std::size_t written_ = 0;  // number of tracked frames at the last write
};

/// Folder of a part of a live run's results, counted from 1.
std::string part_folder(const std::string& out, std::size_t part);

}  // namespace odosplat::apps
