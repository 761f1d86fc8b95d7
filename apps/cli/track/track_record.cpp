// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/track_record.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "apps/command/json_text.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

/// Text as a CSV field: control characters become blanks; quoted if it contains a comma or a quotation mark.
std::string csv_field(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  }
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Why an image that was read got no pose.
const char* reason_lost(const MapEvidence& evidence) {
  switch (evidence.verdict) {
    case Confirmation::contradicted:
      return "the map contradicts the image at the pose that fits best";
    case Confirmation::undecided:
      return "image and map agree in part only";
    case Confirmation::confirmed:
      return "the camera seems to differ from the camera file";
    case Confirmation::none:
      break;
  }
  return "found neither near the last pose nor in the map";
}

}  // namespace

OdometryResults results_of(const Odometry& odometry) {
  return {odometry.trajectory(), odometry.keyframe_times(), odometry.statistics()};
}

void TrackRecord::add(const InputFrame& frame, const TrackResult& result, std::optional<double> latency_ms) {
  ++tracked_;
  tracking_ms_.add(result.milliseconds);
  if (latency_ms) latency_ms_.add(*latency_ms);
  rows_.push_back({frame.time, frame.stamp, result, latency_ms, ""});
}

void TrackRecord::add_unreadable(const InputFrame& frame) {
  if (unreadable_++ == 0) {
    first_fault_ = frame.fault;
    log_warning("frame " + std::to_string(frame.number) + " is lost: " + frame.fault);
  }
  rows_.push_back({frame.time, frame.stamp, {}, std::nullopt, frame.fault});
}

TrackRecord TrackRecord::take_out(std::size_t frames) {
  const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(std::min(frames, rows_.size()));
  TrackRecord old;
  old.rows_.assign(std::make_move_iterator(rows_.begin()), std::make_move_iterator(end));
  rows_.erase(rows_.begin(), end);
  return old;
}

/// The poses of the frames kept. The odometry stores times as numbers; the files repeat the input's stamps as text.
Trajectory TrackRecord::stamped(const Trajectory& trajectory) const {
  Trajectory kept;
  kept.reserve(std::min(trajectory.size(), rows_.size()));
  std::size_t k = 0;
  for (const StampedPose& pose : trajectory) {
    while (k < rows_.size() && rows_[k].time < pose.time) ++k;
    if (k == rows_.size()) break;
    if (rows_[k].time == pose.time) kept.push_back({pose.time, pose.T_world_camera, rows_[k].stamp});
  }
  return kept;
}

TrackOutcome TrackRecord::outcome(const OdometryResults& results, double cpu_seconds) const {
  TrackOutcome o;
  o.trajectory = stamped(results.trajectory);
  const OdometryStatistics& s = results.statistics;
  o.frames = s.frames + static_cast<int>(unreadable_);
  o.dropped = dropped_;
  o.posed = s.posed;
  o.lost = s.lost + static_cast<int>(unreadable_);
  o.relocalisations = s.relocalisations;
  o.keyframes = s.keyframes;
  const std::vector<double> tracking = tracking_ms_.percentiles({50.0, 95.0});
  o.median_ms = tracking[0];
  o.p95_ms = tracking[1];
  const std::vector<double> latency = latency_ms_.percentiles({50.0, 95.0, 99.0});
  o.latency_ms = {latency[0], latency[1], latency[2], latency_ms_.most()};
  o.cpu_ms = 1000.0 * cpu_seconds / std::max(1, s.frames);
  return o;
}

nlohmann::ordered_json TrackRecord::report(const TrackJob& job, const OdometryResults& results,
                                           const TrackFacts& facts) const {
  const TrackOutcome o = outcome(results, facts.cpu_seconds);
  const OdometryStatistics& s = results.statistics;
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const StageTime& stage : s.stages) stages[stage.name] = stage.milliseconds;
  nlohmann::ordered_json report{{"method", job.method},
                                {"frames", o.frames},
                                {"posed", o.posed},
                                {"lost", o.lost},
                                {"unreadable", unreadable_},
                                {"relocalisations", o.relocalisations},
                                {"confirmed", s.confirmed},
                                {"unconfirmed", s.posed - s.confirmed},
                                {"refused", s.refused},
                                {"camera", s.likely_cause},
                                {"keyframes", o.keyframes},
                                {"ms_per_frame", {{"median", o.median_ms}, {"p95", o.p95_ms}}},
                                {"cpu_ms_per_frame", o.cpu_ms},
                                {"stages_ms", stages},
                                {"peak_memory_mb", peak_memory_mb()},
                                {"device", facts.device},
                                {"seed", job.seed},
                                {"version", ODOSPLAT_VERSION},
                                {"finished", facts.finished}};
  for (const auto& [name, value] : job.options.items()) report["options"][name] = std::stod(value);
  if (job.in_real_time()) report["realtime"] = {{"dropped", o.dropped}, {"prefetched", s.prefetched}};
  if (!facts.live.is_null()) {
    report.update(facts.live);
    report["dropped"] = o.dropped;
    report["latency_ms"] = {{"median", o.latency_ms.median},
                            {"p95", o.latency_ms.p95},
                            {"p99", o.latency_ms.p99},
                            {"max", o.latency_ms.most}};
  }
  if (!facts.stream.is_null()) report["stream"] = facts.stream;
  return report;
}

void TrackRecord::write_tables(const std::string& folder, const OdometryResults& results, Durability durability) const {
  Trajectory live;
  for (const Row& row : rows_) {
    if (row.result.status != TrackStatus::lost) live.push_back({row.time, row.result.T_world_camera, row.stamp});
  }
  write_trajectory(folder + "/trajectory.txt", stamped(results.trajectory), durability);
  write_trajectory(folder + "/trajectory_live.txt", live, durability);
  write_file_atomically(folder + "/status.csv", status_table(results.keyframe_times), durability);
  write_file_atomically(folder + "/covariance.csv", covariance_table(), durability);
}

void TrackRecord::write(const TrackJob& job, const OdometryResults& results, const TrackFacts& facts) const {
  const Durability durability = facts.finished ? Durability::synced : Durability::fast;
  write_tables(job.out, results, durability);
  write_file_atomically(job.out + "/report.json", json_text(report(job, results, facts)), durability);
}

std::string TrackRecord::status_table(const std::vector<double>& keyframe_times) const {
  std::string table = "time,status,keyframe,inlier_share,milliseconds,map_share,in_map,confirmed,reason,latency_ms\n";
  for (const Row& row : rows_) {
    const bool keyframe = std::binary_search(keyframe_times.begin(), keyframe_times.end(), row.time);
    const bool judged = row.result.evidence.verdict != Confirmation::none;
    const bool unexplained = row.result.status == TrackStatus::lost && row.reason.empty();
    table +=
        row.stamp +
        formatted(",%s,%d,%.4f,%.3f,%.4f,%d,", to_string(row.result.status).c_str(), keyframe ? 1 : 0,
                  row.result.inlier_share, row.result.milliseconds, row.result.map_share, row.result.in_map ? 1 : 0) +
        (judged ? formatted("%.4f,", row.result.evidence.probability) : ",") +
        csv_field(unexplained ? reason_lost(row.result.evidence) : row.reason) +
        (row.latency_ms ? formatted(",%.3f\n", *row.latency_ms) : ",\n");
  }
  return table;
}

std::string TrackRecord::covariance_table() const {
  static const char* const axes[6] = {"tx", "ty", "tz", "rx", "ry", "rz"};
  std::string table =
      "# upper triangle of the covariance of xi in T_true = exp(xi) T_world_camera of trajectory_live.txt, "
      "xi = (translation [m], rotation [rad])\ntime";
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) table += std::string(",") + axes[i] + "_" + axes[j];
  }
  table += "\n";
  for (const Row& row : rows_) {
    if (row.result.status == TrackStatus::lost) continue;
    table += row.stamp;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) table += formatted(",%.6e", row.result.covariance(i, j));
    }
    table += "\n";
  }
  return table;
}

}  // namespace odosplat::apps
