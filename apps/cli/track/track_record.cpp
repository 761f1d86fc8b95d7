// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/track_record.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command/json_text.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/eval/statistics.hpp"
#include "odosplat/io/atomic_file.hpp"
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

void TrackRecord::add(const Sequence& sequence, std::size_t i, const TrackResult& result) {
  rows_.push_back({sequence.time(i), sequence.time_text(i), result, ""});
}

void TrackRecord::add_unreadable(const Sequence& sequence, std::size_t i, const std::string& reason) {
  if (unreadable_++ == 0) {
    first_fault_ = reason;
    log_warning("frame " + std::to_string(i) + " is lost: " + reason);
  }
  rows_.push_back({sequence.time(i), sequence.time_text(i), {}, reason});
}

TrackOutcome TrackRecord::outcome(const Odometry& odometry, double cpu_seconds) const {
  TrackOutcome o;
  o.trajectory = odometry.trajectory();
  // The odometry stores times as numbers; the files repeat the input's time stamps as text.
  std::size_t k = 0;
  for (StampedPose& pose : o.trajectory) {
    while (rows_[k].time != pose.time) ++k;
    pose.time_text = rows_[k].stamp;
  }
  const OdometryStatistics s = odometry.statistics();
  o.frames = s.frames + static_cast<int>(unreadable_);
  o.dropped = dropped_;
  o.posed = s.posed;
  o.lost = s.lost + static_cast<int>(unreadable_);
  o.relocalisations = s.relocalisations;
  o.keyframes = s.keyframes;
  std::vector<double> sorted;
  for (const Row& row : rows_) {
    if (row.reason.empty()) sorted.push_back(row.result.milliseconds);
  }
  std::sort(sorted.begin(), sorted.end());
  o.median_ms = percentile(sorted, 50.0);
  o.p95_ms = percentile(sorted, 95.0);
  o.cpu_ms = 1000.0 * cpu_seconds / std::max(1, s.frames);
  return o;
}

void TrackRecord::write(const TrackJob& job, const TrackOutcome& o, const Odometry& odometry, const std::string& device,
                        bool finished) const {
  const OdometryStatistics s = odometry.statistics();
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
                                {"device", device},
                                {"seed", job.seed},
                                {"version", ODOSPLAT_VERSION},
                                {"finished", finished}};
  for (const auto& [name, value] : job.options.items()) report["options"][name] = std::stod(value);
  if (job.realtime) report["realtime"] = {{"dropped", o.dropped}, {"prefetched", s.prefetched}};
  Trajectory live;
  for (const Row& row : rows_) {
    if (row.result.status != TrackStatus::lost) live.push_back({row.time, row.result.T_world_camera, row.stamp});
  }
  const Durability durability = finished ? Durability::synced : Durability::fast;
  write_trajectory(job.out + "/trajectory.txt", o.trajectory, durability);
  write_trajectory(job.out + "/trajectory_live.txt", live, durability);
  write_file_atomically(job.out + "/status.csv", status_table(odometry.keyframe_times()), durability);
  write_file_atomically(job.out + "/covariance.csv", covariance_table(), durability);
  write_file_atomically(job.out + "/report.json", json_text(report), durability);
}

std::string TrackRecord::status_table(const std::vector<double>& keyframe_times) const {
  std::string table = "time,status,keyframe,inlier_share,milliseconds,map_share,in_map,confirmed,reason\n";
  for (const Row& row : rows_) {
    const bool keyframe = std::binary_search(keyframe_times.begin(), keyframe_times.end(), row.time);
    const bool judged = row.result.evidence.verdict != Confirmation::none;
    const bool unexplained = row.result.status == TrackStatus::lost && row.reason.empty();
    table +=
        row.stamp +
        formatted(",%s,%d,%.4f,%.3f,%.4f,%d,", to_string(row.result.status).c_str(), keyframe ? 1 : 0,
                  row.result.inlier_share, row.result.milliseconds, row.result.map_share, row.result.in_map ? 1 : 0) +
        (judged ? formatted("%.4f,", row.result.evidence.probability) : ",") +
        csv_field(unexplained ? reason_lost(row.result.evidence) : row.reason) + "\n";
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
