// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "track.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/eval/statistics.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

SE3 start_pose(const TrackJob& job, const Sequence& sequence) {
  if (job.start != "truth") {
    double v[7];
    std::istringstream text(job.start);
    for (double& value : v) {
      if (!(text >> value)) throw InputError("--start", "must be truth or \"tx ty tz qx qy qz qw\", is " + job.start);
    }
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-6)) throw InputError("--start", "the quaternion has length zero");
    return {q, Eigen::Vector3d(v[0], v[1], v[2])};
  }
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (!sequence.T_world_camera(i)) continue;
    if (i > 0) throw InputError(sequence.name(), "its first image has no true pose to start from; give --start");
    log_info("start pose: the sequence's first true pose; nothing more of the truth is used");
    return *sequence.T_world_camera(i);
  }
  throw InputError(sequence.name(), "it has no true pose to start from; give --start \"tx ty tz qx qy qz qw\"");
}

/// Everything that a run writes, gathered frame by frame.
class Recorder {
 public:
  void add(const Sequence& sequence, std::size_t i, const TrackResult& result) {
    const std::string stamp = sequence.time_text(i);
    if (result.status != TrackStatus::lost) live_.push_back({sequence.time(i), result.T_world_camera, stamp});
    char line[160];
    std::snprintf(line, sizeof(line), ",%s,%d,%.4f,%.3f\n", to_string(result.status).c_str(), result.keyframe ? 1 : 0,
                  result.inlier_share, result.milliseconds);
    status_ += stamp + line;
    milliseconds_.push_back(result.milliseconds);
    stamps_.push_back(stamp);
    times_.push_back(sequence.time(i));
  }

  TrackOutcome outcome(const Odometry& odometry) const {
    TrackOutcome o;
    o.trajectory = odometry.trajectory();
    // The odometry knows times as numbers; files repeat the stamps of the input.
    std::size_t k = 0;
    for (StampedPose& pose : o.trajectory) {
      while (times_[k] != pose.time) ++k;
      pose.time_text = stamps_[k];
    }
    const OdometryStatistics s = odometry.statistics();
    o.frames = s.frames;
    o.posed = s.posed;
    o.lost = s.lost;
    o.relocalisations = s.relocalisations;
    o.keyframes = s.keyframes;
    std::vector<double> sorted = milliseconds_;
    std::sort(sorted.begin(), sorted.end());
    o.median_ms = percentile(sorted, 50.0);
    o.p95_ms = percentile(sorted, 95.0);
    return o;
  }

  void write(const TrackJob& job, const TrackOutcome& o, const OdometryStatistics& s, const std::string& device) const {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (const StageTime& stage : s.stages) stages[stage.name] = stage.milliseconds;
    const nlohmann::ordered_json report{{"method", job.method},
                                        {"frames", o.frames},
                                        {"posed", o.posed},
                                        {"lost", o.lost},
                                        {"relocalisations", o.relocalisations},
                                        {"keyframes", o.keyframes},
                                        {"ms_per_frame", {{"median", o.median_ms}, {"p95", o.p95_ms}}},
                                        {"stages_ms", stages},
                                        {"peak_memory_mb", peak_memory_mb()},
                                        {"device", device},
                                        {"seed", job.seed},
                                        {"version", ODOSPLAT_VERSION}};
    write_trajectory(job.out + "/trajectory.txt", o.trajectory);
    write_trajectory(job.out + "/trajectory_live.txt", live_);
    write_file_atomically(job.out + "/status.csv", "time,status,keyframe,inlier_share,milliseconds\n" + status_);
    write_file_atomically(job.out + "/report.json", report.dump(2) + "\n");
  }

 private:
  Trajectory live_;
  std::string status_;
  std::vector<double> milliseconds_;
  std::vector<std::string> stamps_;
  std::vector<double> times_;
};

}  // namespace

OdometryOptions odometry_options(const TrackJob& job) {
  OdometryOptions options;
  options.keyframe.anchor.enabled = job.anchor;
  options.keyframe.selector.seed = job.seed;
  return options;
}

TrackOutcome track_sequence(const Common& common, const TrackJob& job) {
  ensure_output_folder(job.out);
  const Sequence sequence = open_sequence(job.sequence);
  if (sequence.size() == 0) throw InputError(sequence.name(), "holds no images");
  OpenedView opened = open_view(common, job.method, job.map);
  const SE3 T_world_camera_start = start_pose(job, sequence);
  Odometry odometry(sequence.camera(), *opened.view, odometry_options(job), T_world_camera_start);
  Recorder recorder;
  Progress progress("track", static_cast<long>(sequence.size()));
  std::size_t i = 0;
  for (; i < sequence.size() && !interrupted(); ++i) {
    if (opened.sensor != nullptr) opened.sensor->set_depth(sequence.has_depth(i) ? sequence.depth(i) : DepthImage());
    const TrackResult result = odometry.track(sequence.gray(i), sequence.time(i));
    recorder.add(sequence, i, result);
    progress.update(static_cast<long>(i) + 1, to_string(result.status) + "  " +
                                                  std::to_string(odometry.statistics().keyframes) + " keyframes  " +
                                                  std::to_string(odometry.statistics().lost) + " lost");
  }
  progress.finish();
  const TrackOutcome outcome = recorder.outcome(odometry);
  recorder.write(job, outcome, odometry.statistics(), opened.device ? opened.device->device().name : "none");
  if (opened.device) print_profile(common, *opened.device);
  if (i < sequence.size()) throw Interrupted();
  return outcome;
}

void add_track(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "track", "localise a sequence's camera in a map");
  auto job = std::make_shared<TrackJob>();
  auto anchor = std::make_shared<std::string>("on");
  add_sequence_flags(command, job->sequence);
  add_map_flags(command, job->map);
  command->add_option("--method", job->method, "gaussian, paper, interpolation or rgbd");
  command->add_option("--out", job->out, "folder for trajectory.txt, trajectory_live.txt, status.csv, report.json")
      ->required();
  command->add_option("--start", job->start, "pose of the first image: truth, or \"tx ty tz qx qy qz qw\" [m]");
  command->add_option("--anchor", *anchor, "align keyframes with the map's rendered image: on or off")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_option("--seed", job->seed, "seed of the pixel selector");
  command->final_callback([&common, job, anchor] {
    job->anchor = *anchor == "on";
    const TrackOutcome o = track_sequence(common, *job);
    std::printf("%s: %d of %d frames posed, %d lost, %d keyframes, %.1f ms a frame (95 %%: %.1f ms)\n",
                job->out.c_str(), o.posed, o.frames, o.lost, o.keyframes, o.median_ms, o.p95_ms);
  });
}

}  // namespace odosplat::apps
