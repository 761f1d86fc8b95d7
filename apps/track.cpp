// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "track.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "frame_reader.hpp"
#include "number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "places.hpp"
#include "playback.hpp"
#include "track_record.hpp"

namespace odosplat::apps {
namespace {

SE3 start_pose(const TrackJob& job, const Sequence& sequence, const FrameRange& range) {
  if (job.start != "truth") {
    double v[7];
    std::istringstream text(job.start);
    for (double& value : v) {
      if (!(text >> value))
        throw InputError("--start", "must be truth, auto or \"tx ty tz qx qy qz qw\", is " + job.start);
    }
    if (std::string more; text >> more) throw InputError("--start", "has more than seven numbers: " + job.start);
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-6)) throw InputError("--start", "the quaternion has length zero");
    return {q, Eigen::Vector3d(v[0], v[1], v[2])};
  }
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (!sequence.T_world_camera(i)) continue;
    if (i > range.begin)
      throw InputError(sequence.name(), "its first image has no true pose to start from; give --start");
    log_info("start pose: the sequence's first true pose; nothing more of the truth is used");
    return *sequence.T_world_camera(i);
  }
  throw InputError(sequence.name(), "it has no true pose to start from; give --start \"tx ty tz qx qy qz qw\"");
}

/// A run in the making: what the two ways of playing a sequence share.
class Run {
 public:
  Run(const Sequence& sequence, const FrameRange& range, OpenedView& opened, Odometry& odometry, TrackRecord& record)
      : sequence_(sequence),
        range_(range),
        opened_(opened),
        odometry_(odometry),
        record_(record),
        reader_(sequence, range),
        progress_("track", static_cast<long>(range.end - range.begin)) {}

  /// Every frame, one after the other. False after Ctrl-C.
  bool play() {
    for (std::size_t i = range_.begin; i < range_.end; ++i) {
      if (interrupted()) return false;
      track(i);
    }
    progress_.finish();
    return true;
  }

  /// At the sequence's own rate: frames that are no longer the newest are dropped.
  bool play_in_real_time() {
    Playback playback(sequence_, range_);
    while (const std::optional<std::size_t> i = playback.next()) {
      if (interrupted()) return false;
      record_.drop(playback.dropped());
      track(*i);
    }
    odometry_.finish();
    progress_.finish();
    return true;
  }

 private:
  void track(std::size_t i) {
    std::shared_ptr<SensorView> view;
    if (opened_.sensor != nullptr) {
      // A keyframe that is made later must see the depth of its own frame.
      opened_.show_frame(sequence_, i);
      view = std::make_shared<SensorView>(*opened_.sensor);
    }
    const TrackResult result = odometry_.track(reader_.take(i), sequence_.time(i), view);
    record_.add(sequence_, i, result);
    const OdometryStatistics s = odometry_.statistics();
    std::string words = to_string(result.status) + "  " + std::to_string(s.keyframes) + " keyframes  " +
                        std::to_string(s.lost) + " lost";
    if (record_.dropped() > 0) words += "  " + std::to_string(record_.dropped()) + " dropped";
    progress_.update(static_cast<long>(i - range_.begin) + 1, words);
  }

  const Sequence& sequence_;
  const FrameRange range_;
  OpenedView& opened_;
  Odometry& odometry_;
  TrackRecord& record_;
  FrameReader reader_;
  Progress progress_;
};

}  // namespace

OdometryOptions odometry_options(const TrackJob& job) {
  OdometryOptions options = odometry_options(method_preset(job.method), job.anchor);
  if (!job.depth_use.empty()) options.keyframe.window_points.depth_use = depth_use(job.depth_use);
  options.keyframe.selector.seed = job.seed;
  options.background = job.realtime;
  return options;
}

std::unique_ptr<Relocalizer> make_relocalizer(const TrackJob& job, const Camera& camera, MapView& map, bool sensor) {
  if (sensor) {
    if (job.start == "auto") throw InputError("--start", "auto needs a map, which method rgbd has not");
    return nullptr;
  }
  if (!job.relocalise && job.start != "auto") return nullptr;
  return std::make_unique<Relocalizer>(camera, map, places_of(job.map, job.places));
}

namespace {

std::unique_ptr<Odometry> start_odometry(const TrackJob& job, const Sequence& sequence, const FrameRange& range,
                                         const OpenedView& opened, Relocalizer* relocalizer) {
  const OdometryOptions options = odometry_options(job);
  // The first rendering loads the device's programs, and a look-up renders every place: a camera would not wait.
  if (job.start == "auto") {
    if (job.realtime) relocalizer->prepare();
    return std::make_unique<Odometry>(sequence.camera(), *opened.view, options, *relocalizer);
  }
  const SE3 T_world_camera_start = start_pose(job, sequence, range);
  if (job.realtime && opened.sensor == nullptr) {
    opened.view->render(sequence.camera(), T_world_camera_start, {true, true});
    if (relocalizer != nullptr) relocalizer->prepare();
  }
  auto odometry = std::make_unique<Odometry>(sequence.camera(), *opened.view, options, T_world_camera_start);
  odometry->set_relocalizer(relocalizer);
  return odometry;
}

}  // namespace

TrackOutcome track_sequence(const Common& common, const TrackJob& job) {
  ensure_output_folder(job.out);
  const Sequence sequence = open_sequence(job.sequence);
  if (sequence.size() == 0) throw InputError(sequence.name(), "holds no images");
  FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
  range.end = std::min(range.end, sequence.size());
  if (range.begin >= range.end)
    throw InputError("--frames", "is " + job.frames + ", the sequence has " + std::to_string(sequence.size()));
  OpenedView opened = open_view(common, job.method, job.map, {job.depth_noise.model, job.seed});
  const auto relocalizer = make_relocalizer(job, sequence.camera(), *opened.view, opened.sensor != nullptr);
  const auto started = start_odometry(job, sequence, range, opened, relocalizer.get());
  Odometry& odometry = *started;
  TrackRecord record;
  const double cpu_before = cpu_seconds();
  const bool played = [&] {
    Run run(sequence, range, opened, odometry, record);
    return job.realtime ? run.play_in_real_time() : run.play();
  }();
  const TrackOutcome outcome = record.outcome(odometry, cpu_seconds() - cpu_before);
  record.write(job, outcome, odometry, opened.device ? opened.device->device().name : "none");
  if (opened.device) print_profile(common, *opened.device);
  if (!played) throw Interrupted();
  return outcome;
}

void add_track(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "track", "localise a sequence's camera in a map");
  auto job = std::make_shared<TrackJob>();
  auto anchor = std::make_shared<std::string>();
  auto relocalise = std::make_shared<std::string>("on");
  add_sequence_flags(command, job->sequence);
  add_map_flags(command, job->map);
  command->add_option("--method", job->method, method_names());
  command
      ->add_option("--out", job->out,
                   "folder for trajectory.txt, trajectory_live.txt, status.csv, covariance.csv, report.json")
      ->required();
  command->add_option("--frames", job->frames, frames_help);
  command->add_option("--start", job->start,
                      "pose of the first image: truth, \"tx ty tz qx qy qz qw\" [m], or auto (it is looked up)");
  command->add_option("--relocalise", *relocalise, "look images up in the map when lost: on or off")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_option("--places", job->places, places_help);
  command
      ->add_option("--anchor", *anchor,
                   "align keyframes with the map's rendered image: on or off (default: on for gaussian, else off)")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_flag("--realtime", job->realtime,
                    "play at the sequence's rate: keyframes in the background, late frames are dropped (default: every "
                    "frame, same bits every time)");
  command->add_option("--depth-use", job->depth_use,
                      "what the window makes of the map's depth: fixed, pose_aware, prior, pose_aware_prior, free or "
                      "interval (default: the method's)");
  add_depth_noise_flag(command, job->depth_noise);
  add_number(command, "--seed", job->seed, {}, "seed of the pixel selector and of depth noise");
  command->final_callback([&common, job, anchor, relocalise] {
    job->relocalise = *relocalise == "on";
    if (!anchor->empty()) job->anchor = *anchor == "on";
    const TrackOutcome o = track_sequence(common, *job);
    print("%s: %d of %d frames posed, %d lost, %d keyframes, %.1f ms a frame (95 %%: %.1f ms)\n", job->out.c_str(),
          o.posed, o.frames, o.lost, o.keyframes, o.median_ms, o.p95_ms);
    if (job->realtime) {
      print("in real time: %d of %d frames dropped\n", o.dropped, o.dropped + o.frames);
    }
  });
}

}  // namespace odosplat::apps
