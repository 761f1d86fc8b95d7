// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/track_run.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <utility>

#include "apps/command/interrupt.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat::apps {
namespace {

/// Of a part: ten minutes at 30 Hz.
constexpr std::size_t usual_part_frames = 18'000;
/// Newest frames that are not put aside yet, since keyframes in the making still change their poses; at most as many as
/// a part has.
constexpr std::size_t most_unsettled = 300;

double milliseconds_since(std::chrono::steady_clock::time_point when) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - when).count();
}

template <typename T>
bool runs(const std::future<T>& task) {
  return task.valid() && task.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

}  // namespace

std::string part_folder(const std::string& out, std::size_t part) { return out + formatted("/part-%06zu", part); }

TrackRun::TrackRun(const TrackJob& job, FrameSource& source, Odometry& odometry, TrackRecord& record,
                   const std::string& device, PoseStream* stream)
    : job_(job),
      source_(source),
      odometry_(odometry),
      record_(record),
      device_(device),
      stream_(stream),
      progress_("track", source.size() ? static_cast<long>(*source.size()) : Progress::unknown),
      part_frames_(job.is_live() ? std::optional(job.live.part_frames.value_or(usual_part_frames)) : std::nullopt) {}

bool TrackRun::play() {
  source_.start();
  while (const std::optional<InputFrame> frame = source_.next([this] {
    write_now_and_then();
    return interrupted();
  })) {
    track(*frame);
  }
  if (interrupted()) return false;
  odometry_.finish();
  progress_.finish();
  return true;
}

void TrackRun::track(const InputFrame& frame) {
  record_.drop(frame.dropped);
  done_ += static_cast<long>(frame.dropped) + 1;
  TrackStatus status = TrackStatus::lost;
  if (frame.image.empty()) {
    record_.add_unreadable(frame);
    if (stream_ != nullptr) stream_->send(pose_line(frame, nullptr, std::nullopt));
  } else {
    const TrackResult result = odometry_.track(frame.image, frame.time, frame.view);
    std::optional<double> latency_ms;
    if (frame.arrival) latency_ms = milliseconds_since(*frame.arrival);
    if (stream_ != nullptr) stream_->send(pose_line(frame, &result, latency_ms));
    record_.add(frame, result, latency_ms);
    status = result.status;
  }
  report_progress(frame, status);
  if (part_frames_ && record_.kept() >= *part_frames_ + std::min(*part_frames_, most_unsettled)) put_aside();
}

void TrackRun::report_progress(const InputFrame& frame, TrackStatus status) {
  const OdometryStatistics s = odometry_.statistics();
  if (!s.likely_cause.empty() && !warned_of_camera_) {
    warned_of_camera_ = true;
    log_warning(source_.name() + ": " + s.likely_cause + "; poses that this changes by centimetres are refused");
  }
  std::string words = to_string(status) + "  " + std::to_string(s.keyframes) + " keyframes  " +
                      std::to_string(s.lost + static_cast<int>(record_.unreadable())) + " lost";
  if (record_.dropped() > 0) words += "  " + std::to_string(record_.dropped()) + " dropped";
  if (frame.arrival) words += formatted("  %.0f ms", milliseconds_since(*frame.arrival));
  progress_.update(done_, words);
}

TrackFacts TrackRun::facts(bool finished) const {
  TrackFacts facts;
  facts.device = device_;
  facts.cpu_seconds = cpu_seconds() - cpu_before_;
  facts.finished = finished;
  facts.live = source_.facts();
  if (!facts.live.is_null()) facts.live["parts"] = parts_;
  if (stream_ != nullptr) {
    facts.stream = {{"to", stream_->where()}, {"sent", stream_->sent()}, {"dropped", stream_->dropped()}};
  }
  return facts;
}

TrackOutcome TrackRun::write(bool finished) {
  if (writing_.valid()) writing_.wait();
  for (int attempt = 0; attempt < 2 && !part_is_written(); ++attempt) write_part();
  if (!part_is_written()) log_warning(part_->folder + ": cannot be written: these results are lost");
  const OdometryResults results = results_of(odometry_);
  const TrackFacts now = facts(finished);
  record_.write(job_, results, now);
  return record_.outcome(results, now.cpu_seconds);
}

/// Writes intermediate results, so that a run that is killed loses only a few seconds. If writing takes long, it is done
/// more rarely.
void TrackRun::write_now_and_then() {
  if (writing_.valid()) {
    if (writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    const Written written = writing_.get();
    note_written(written.ok, written.seconds);
  }
  if (since_write_.seconds() < next_write_ || record_.tracked() == written_) return;
  written_ = record_.tracked();
  const auto write_these = [this](const TrackRecord& record, const OdometryResults& results, const TrackFacts& now) {
    const Stopwatch watch;
    try {
      record.write(job_, results, now);
      return Written{true, watch.seconds()};
    } catch (const InputError& e) {  // for example a full disk, which may have space again later
      log_warning(e.what());
      return Written{false, watch.seconds()};
    }
  };
  if (!job_.in_real_time()) {
    const Written written = write_these(record_, results_of(odometry_), facts(false));
    note_written(written.ok, written.seconds);
    return;
  }
  const auto copy = std::make_shared<const TrackRecord>(record_);
  const auto results = std::make_shared<const OdometryResults>(results_of(odometry_));
  writing_ = std::async(std::launch::async,
                        [write_these, copy, results, now = facts(false)] { return write_these(*copy, *results, now); });
}

void TrackRun::note_written(bool ok, double seconds) {
  constexpr double interval = 5.0;
  constexpr double share = 0.02;  // largest share of the time spent on writing
  next_write_ = ok ? std::max(interval, seconds / share) : 4.0 * next_write_;
  since_write_ = Stopwatch();
}

/// Moves all but the newest results into a folder of their own. Their poses are final from here on.
void TrackRun::put_aside() {
  if (runs(writing_part_) || runs(writing_)) return;  // later: the disk is slow
  if (!part_is_written()) {
    write_part();  // again: a full disk may have space now; meanwhile the record grows
    return;
  }
  const auto results = std::make_shared<const OdometryResults>(results_of(odometry_));
  const auto old = std::make_shared<const TrackRecord>(record_.take_out(*part_frames_));
  odometry_.forget(record_.first_time());
  part_ = Part{old, results, part_folder(job_.out, ++parts_)};
  write_part();
}

/// Waits for the part that is being written; true if none is left.
bool TrackRun::part_is_written() {
  if (writing_part_.valid() && writing_part_.get()) part_.reset();
  return !part_;
}

void TrackRun::write_part() {
  writing_part_ = std::async(std::launch::async, [part = *part_] {
    try {
      part.record->write_tables(part.folder, *part.results, Durability::synced);
      return true;
    } catch (const std::exception& e) {
      log_warning(part.folder + ": " + e.what() + "; it is tried again");
      return false;
    }
  });
}

}  // namespace odosplat::apps
