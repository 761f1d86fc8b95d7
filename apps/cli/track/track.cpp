// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/track.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "apps/cli/track/frame_reader.hpp"
#include "apps/cli/track/playback.hpp"
#include "apps/cli/track/track_record.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/places.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"

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
    try {
      SE3 start(rotation_from_text(q), Eigen::Vector3d(v[0], v[1], v[2]));
      if (!start.is_finite()) throw InputError("the position is not finite");
      return start;
    } catch (const InputError& e) {
      throw InputError("--start", e.what());
    }
  }
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (!sequence.T_world_camera(i)) continue;
    if (i > range.begin)
      throw InputError(sequence.name(), "its first image has no true pose to start from; give --start auto or a pose");
    log_info("start pose: the sequence's first true pose; nothing more of the truth is used");
    return *sequence.T_world_camera(i);
  }
  throw InputError(sequence.name(),
                   "it has no true pose to start from; give --start auto, or --start \"tx ty tz qx qy qz qw\"");
}

/// Sets the frame's depth image in a sensor's view and returns a copy of the view, because a keyframe made later from
/// this frame still needs its depth; null for maps.
std::shared_ptr<SensorView> sensor_view_of(OpenedView& opened, const Sequence& sequence, std::size_t i) {
  if (opened.sensor == nullptr) return nullptr;
  opened.show_frame(sequence, i);
  return std::make_shared<SensorView>(*opened.sensor);
}

/// The range without unreadable frames at its beginning, which are recorded as lost: the start pose belongs to the
/// first image that is tracked. InputError if no frame can be read.
FrameRange readable_range(const Sequence& sequence, FrameRange range, OpenedView& opened, TrackRecord& record) {
  for (; range.begin < range.end; ++range.begin) {
    if (interrupted()) throw Interrupted();
    try {
      sensor_view_of(opened, sequence, range.begin);
      sequence.gray(range.begin);
      return range;
    } catch (const InputError& e) {
      record.add_unreadable(sequence, range.begin, e.what());
    }
  }
  throw InputError("none of the " + std::to_string(record.unreadable()) +
                   " frames can be read: " + record.first_fault());
}

/// State of a run; shared by play() and play_in_real_time().
class Run {
 public:
  Run(const TrackJob& job, const Sequence& sequence, const FrameRange& range, OpenedView& opened, Odometry& odometry,
      TrackRecord& record)
      : job_(job),
        sequence_(sequence),
        range_(range),
        opened_(opened),
        odometry_(odometry),
        record_(record),
        reader_(sequence, range),
        progress_("track", static_cast<long>(range.end - range.begin)) {}

  /// Tracks every frame in order. False after Ctrl-C.
  bool play() {
    for (std::size_t i = range_.begin; i < range_.end; ++i) {
      if (interrupted()) return false;
      track(i);
    }
    progress_.finish();
    return true;
  }

  /// Plays at the sequence's own rate: frames that are no longer the newest are dropped. False after Ctrl-C.
  bool play_in_real_time() {
    Playback playback(sequence_, range_);
    while (const std::optional<std::size_t> i = playback.next([this] {
      write_now_and_then();
      return interrupted();
    })) {
      record_.drop(playback.dropped());
      track(*i);
    }
    if (interrupted()) return false;
    odometry_.finish();
    progress_.finish();
    return true;
  }

  /// Writes the results so far; finished: they are complete.
  TrackOutcome write(bool finished) {
    TrackOutcome outcome = record_.outcome(odometry_, cpu_seconds() - cpu_before_);
    record_.write(job_, outcome, odometry_, opened_.device ? opened_.device->device().name : "none", finished);
    return outcome;
  }

 private:
  void track(std::size_t i) {
    TrackStatus status = TrackStatus::lost;
    std::shared_ptr<SensorView> view;
    if (const std::optional<GrayImage> image = read(i, view)) {
      const TrackResult result = odometry_.track(*image, sequence_.time(i), view);
      record_.add(sequence_, i, result);
      status = result.status;
    }
    const OdometryStatistics s = odometry_.statistics();
    if (!s.likely_cause.empty() && !warned_of_camera_) {
      warned_of_camera_ = true;
      log_warning(sequence_.name() + ": " + s.likely_cause + "; poses that this changes by centimetres are refused");
    }
    std::string words = to_string(status) + "  " + std::to_string(s.keyframes) + " keyframes  " +
                        std::to_string(s.lost + static_cast<int>(record_.unreadable())) + " lost";
    if (record_.dropped() > 0) words += "  " + std::to_string(record_.dropped()) + " dropped";
    progress_.update(static_cast<long>(i - range_.begin) + 1, words);
    write_now_and_then();
  }

  /// Reads a frame. An unreadable file loses only its own frame: it is recorded, and nothing is returned.
  std::optional<GrayImage> read(std::size_t i, std::shared_ptr<SensorView>& view) {
    try {
      view = sensor_view_of(opened_, sequence_, i);
      return reader_.take(i);
    } catch (const InputError& e) {
      record_.add_unreadable(sequence_, i, e.what());
      return std::nullopt;
    }
  }

  /// Writes intermediate results, so that a run that is killed loses only a few seconds. If writing takes long, it is
  /// done more rarely.
  void write_now_and_then() {
    constexpr double interval = 5.0;
    constexpr double share = 0.02;  // largest share of the time spent on writing
    if (since_write_.seconds() < next_write_ || record_.tracked() == written_) return;
    written_ = record_.tracked();
    const Stopwatch watch;
    try {
      write(false);
      next_write_ = std::max(interval, watch.seconds() / share);
    } catch (const InputError& e) {  // for example a full disk, which may have space again later
      log_warning(e.what());
      next_write_ *= 4.0;
    }
    since_write_ = Stopwatch();
  }

  const TrackJob& job_;
  const Sequence& sequence_;
  const FrameRange range_;
  OpenedView& opened_;
  Odometry& odometry_;
  TrackRecord& record_;
  FrameReader reader_;
  Progress progress_;
  const double cpu_before_ = cpu_seconds();
  Stopwatch since_write_;
  double next_write_ = 5.0;  // [s] between two writes
  std::size_t written_ = 0;  // number of tracked frames at the last write
  bool warned_of_camera_ = false;
};

}  // namespace

OdometryOptions odometry_options(const TrackJob& job) {
  OdometryOptions options = odometry_options(method_preset(job.method), job.anchor);
  if (!job.depth_use.empty()) options.keyframe.window_points.depth_use = depth_use(job.depth_use);
  options.keyframe.selector.seed = job.seed;
  options.background = job.realtime;
  job.options.apply(options);
  return options;
}

std::unique_ptr<Relocalizer> make_relocalizer(const TrackJob& job, const Camera& camera, MapView& map, bool sensor) {
  if (sensor) {
    if (job.start == "auto") throw InputError("--start", "auto needs a map, which method rgbd has not");
    return nullptr;
  }
  if (!job.relocalise && job.start != "auto") return nullptr;
  RelocalizerOptions options;
  job.options.apply(options);
  return std::make_unique<Relocalizer>(camera, map, places_of(job.map, job.places), options);
}

namespace {

std::unique_ptr<Odometry> start_odometry(const TrackJob& job, const Sequence& sequence, const FrameRange& range,
                                         const OpenedView& opened, Relocalizer* relocalizer) {
  const OdometryOptions options = odometry_options(job);
  // The first rendering loads the device's programs and the first look-up renders all places. In real time this is done
  // in advance, because frames would be dropped meanwhile.
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

/// Writes the results so far while an error is being passed on. A failure here is only logged, so that the first error
/// is the one reported.
void write_what_there_is(Run& run, const TrackRecord& record) {
  if (record.tracked() == 0) return;
  try {
    run.write(false);
  } catch (const std::exception& e) {
    log_warning(e.what());
  }
}

}  // namespace

TrackOutcome track_sequence(const Common& common, const TrackJob& job) {
  const MadeFolders made = ensure_output_folder(job.out);
  const Sequence sequence = open_sequence(job.sequence);
  if (sequence.size() == 0) throw InputError(sequence.name(), "holds no images");
  FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
  range.end = std::min(range.end, sequence.size());
  if (range.begin >= range.end)
    throw InputError("--frames", "is " + job.frames + ", the sequence has " + std::to_string(sequence.size()));
  OpenedView opened = open_view(common, job.method, job.map, {job.depth_noise.model, job.seed});
  const auto relocalizer = make_relocalizer(job, sequence.camera(), *opened.view, opened.sensor != nullptr);
  if (relocalizer == nullptr && job.options.has("relocaliser")) {
    log_warning("--set relocaliser.*: is not used, as nothing is looked up (--relocalise off, or method rgbd)");
  }
  TrackRecord record;
  range = readable_range(sequence, range, opened, record);
  const auto started = start_odometry(job, sequence, range, opened, relocalizer.get());
  const SavesWhenInterrupted saves;
  Run run(job, sequence, range, opened, *started, record);
  bool played = false;
  try {
    played = job.realtime ? run.play_in_real_time() : run.play();
  } catch (...) {
    write_what_there_is(run, record);
    throw;
  }
  if (!played && record.tracked() == 0) throw Interrupted();  // keeps the results of an earlier run
  TrackOutcome outcome = run.write(played);
  if (record.unreadable() > 0) {
    log_warning(std::to_string(record.unreadable()) + " of " + std::to_string(outcome.frames) +
                " frames cannot be read and count as lost; status.csv has the reasons");
  }
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
                      "how the window uses the map's depth: fixed, pose_aware, prior, pose_aware_prior, free or "
                      "interval (default: the method's)");
  add_depth_noise_flag(command, job->depth_noise);
  add_number(command, "--seed", job->seed, {}, "seed of the pixel selector and of depth noise");
  auto settings = std::make_shared<std::vector<std::string>>();
  const std::vector<std::string> groups{"odometry", "relocaliser"};
  add_set_flag(command, *settings, groups);
  command->final_callback([&common, job, anchor, relocalise, settings, groups] {
    job->options = OptionValues(*settings, groups);
    job->relocalise = *relocalise == "on";
    if (!anchor->empty()) job->anchor = *anchor == "on";
    check_flags_of_method(job->method, job->map, job->depth_noise);
    const TrackOutcome o = track_sequence(common, *job);
    print("%s: %d of %d frames posed, %d lost, %d keyframes, %.1f ms a frame (95 %%: %.1f ms)\n", job->out.c_str(),
          o.posed, o.frames, o.lost, o.keyframes, o.median_ms, o.p95_ms);
    if (job->realtime) {
      print("in real time: %d of %d frames dropped\n", o.dropped, o.dropped + o.frames);
    }
    if (o.posed == 0) {
      throw NoResult(
          job->out + ": none of " + std::to_string(o.frames) +
          " frames posed: the map does not show what the images show, or the start pose or the camera is wrong");
    }
  });
}

}  // namespace odosplat::apps
