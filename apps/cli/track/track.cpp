// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/track.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "apps/cli/track/live_frames.hpp"
#include "apps/cli/track/pose_stream.hpp"
#include "apps/cli/track/sequence_frames.hpp"
#include "apps/cli/track/track_record.hpp"
#include "apps/cli/track/track_run.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/method.hpp"
#include "apps/input/places.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/video/live_address.hpp"

namespace odosplat::apps {
namespace {

/// The pose that --start gives.
SE3 given_start(const TrackJob& job) {
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

SE3 start_pose(const TrackJob& job, const Sequence& sequence, const FrameRange& range) {
  if (job.start != "truth" && !job.start.empty()) return given_start(job);
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

/// The range without unreadable frames at its beginning, which are recorded as lost: the start pose belongs to the
/// first image that is tracked. InputError if no frame can be read.
FrameRange readable_range(const Sequence& sequence, FrameRange range, OpenedView& opened, TrackRecord& record,
                          PoseStream* stream) {
  for (; range.begin < range.end; ++range.begin) {
    if (interrupted()) throw Interrupted();
    try {
      sensor_view_of(opened, sequence, range.begin);
      sequence.gray(range.begin);
      return range;
    } catch (const InputError& e) {
      InputFrame frame = frame_of(sequence, range.begin);
      frame.fault = e.what();
      record.add_unreadable(frame);
      if (stream != nullptr) stream->send(pose_line(frame, nullptr, std::nullopt));
    }
  }
  throw InputError("none of the " + std::to_string(record.unreadable()) +
                   " frames can be read: " + record.first_fault());
}

}  // namespace

OdometryOptions odometry_options(const TrackJob& job) {
  OdometryOptions options = odometry_options(method_preset(job.method), job.anchor);
  if (!job.depth_use.empty()) options.keyframe.window_points.depth_use = depth_use(job.depth_use);
  options.keyframe.selector.seed = job.seed;
  options.background = job.in_real_time();
  job.options.apply(options);
  return options;
}

std::unique_ptr<Relocalizer> make_relocalizer(const TrackJob& job, const Camera& camera, MapView& map, bool sensor) {
  if (sensor) {
    if (job.finds_start()) throw InputError("--start", "auto needs a map, which method rgbd has not");
    return nullptr;
  }
  if (!job.relocalise && !job.finds_start()) return nullptr;
  RelocalizerOptions options;
  job.options.apply(options);
  return std::make_unique<Relocalizer>(camera, map, places_of(job.map, job.places), options);
}

namespace {

/// Writes the results so far while an error is being passed on. A failure here is only logged, so that the first error
/// is the one reported.
void write_what_there_is(TrackRun& run, const TrackRecord& record) {
  if (record.tracked() == 0) return;
  try {
    run.write(false);
  } catch (const std::exception& e) {
    log_warning(e.what());
  }
}

/// The part of a run that recorded sequences and live sources share. relocalizer and start: as for start_odometry.
TrackOutcome track_frames(const Common& common, const TrackJob& job, FrameSource& source, OpenedView& opened,
                          Relocalizer* relocalizer, const std::optional<SE3>& T_world_camera_start, TrackRecord& record,
                          PoseStream* stream) {
  const auto started = start_odometry(source.camera(), *opened.view, odometry_options(job), relocalizer,
                                      T_world_camera_start, job.in_real_time() && opened.sensor == nullptr);
  const SavesWhenInterrupted saves;
  TrackRun run(job, source, *started, record, opened.device ? opened.device->device().name : "none", stream);
  bool played = false;
  try {
    played = run.play();
  } catch (...) {
    write_what_there_is(run, record);
    throw;
  }
  if (!played && record.tracked() == 0) throw Interrupted();  // keeps the results of an earlier run
  if (stream != nullptr) stream->finish();
  TrackOutcome outcome = run.write(played);
  if (record.unreadable() > 0) {
    log_warning(std::to_string(record.unreadable()) + " of " + std::to_string(outcome.frames) +
                " frames cannot be read and count as lost; status.csv has the reasons");
  }
  if (opened.device) print_profile(common, *opened.device);
  if (!played) throw Interrupted();
  return outcome;
}

std::unique_ptr<Relocalizer> opened_relocalizer(const TrackJob& job, const Camera& camera, const OpenedView& opened) {
  auto relocalizer = make_relocalizer(job, camera, *opened.view, opened.sensor != nullptr);
  if (relocalizer == nullptr && job.options.has("relocaliser")) {
    log_warning("--set relocaliser.*: is not used, as nothing is looked up (--relocalise off, or method rgbd)");
  }
  return relocalizer;
}

TrackOutcome track_recorded(const Common& common, const TrackJob& job, PoseStream* stream) {
  const Sequence sequence = open_sequence(job.sequence);
  if (sequence.size() == 0) throw InputError(sequence.name(), "holds no images");
  FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
  range.end = std::min(range.end, sequence.size());
  if (range.begin >= range.end)
    throw InputError("--frames", "is " + job.frames + ", the sequence has " + std::to_string(sequence.size()));
  OpenedView opened = open_view(common, job.method, job.map, {job.depth_noise.model, job.seed});
  const auto relocalizer = opened_relocalizer(job, sequence.camera(), opened);
  TrackRecord record;
  range = readable_range(sequence, range, opened, record, stream);
  std::optional<SE3> start;
  if (!job.finds_start()) start = start_pose(job, sequence, range);
  SequenceFrames frames(sequence, range, opened, job.realtime);
  return track_frames(common, job, frames, opened, relocalizer.get(), start, record, stream);
}

TrackOutcome track_live(const Common& common, const TrackJob& job, PoseStream* stream) {
  if (const std::string part = part_folder(job.out, 1); std::filesystem::exists(part)) {
    throw InputError(part,
                     "is there from an earlier run, whose parts would be mixed with this one's: take another --out");
  }
  std::optional<SE3> start;
  if (!job.finds_start()) start = given_start(job);
  // The source first: its faults are found at once, the map takes a while.
  LiveFrames frames(job);
  OpenedView opened = open_view(common, job.method, job.map);
  const auto relocalizer = opened_relocalizer(job, frames.camera(), opened);
  TrackRecord record;
  return track_frames(common, job, frames, opened, relocalizer.get(), start, record, stream);
}

void print_outcome(const TrackJob& job, const TrackOutcome& o) {
  std::string text = formatted("%s: %d of %d frames posed, %d lost, %d keyframes, %.1f ms a frame (95 %%: %.1f ms)\n",
                               job.out.c_str(), o.posed, o.frames, o.lost, o.keyframes, o.median_ms, o.p95_ms);
  if (job.in_real_time()) text += formatted("in real time: %d of %d frames dropped\n", o.dropped, o.dropped + o.frames);
  if (job.is_live()) {
    text += formatted("from arrival to pose: %.1f ms (95 %%: %.1f ms, most: %.1f ms)\n", o.latency_ms.median,
                      o.latency_ms.p95, o.latency_ms.most);
  }
  if (job.stream != "-") {
    print("%s", text.c_str());
    return;
  }
  // Standard output has the poses.
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) log_info(line);
}

}  // namespace

TrackOutcome track_sequence(const Common& common, const TrackJob& job) {
  check_live_flags(job);
  const MadeFolders made = ensure_output_folder(job.out);
  std::optional<PoseStream> stream;
  if (!job.stream.empty()) stream.emplace(job.stream);
  PoseStream* const to = stream ? &*stream : nullptr;
  return job.is_live() ? track_live(common, job, to) : track_recorded(common, job, to);
}

namespace {

void add_live_flags(CLI::App* command, TrackJob& job) {
  const LiveOptions usual;
  command->add_option("--stream", job.stream,
                      "also send a line of JSON per frame: - (standard output; results go to standard error) or "
                      "udp://HOST:PORT; lines that its reader is too slow for are dropped");
  add_number(command, "--reconnect", job.live.reconnect, {.least = 0.0, .most = 1e9, .word = "60"},
             "a live source that closes or falls silent is opened again for so long [s]; 0: it has ended");
  add_number(command, "--open-timeout", job.live.open_timeout,
             {.least = 0.0, .most = 3600.0, .least_excluded = true, .word = "10"},
             "wait so long for the first image of a live source [s]");
  add_number(command, "--part-frames", job.live.part_frames, {.least = 1, .word = "18000"},
             "results of a live source are put aside in folders part-000001, ... of about so many frames each");
}

}  // namespace

void add_track(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "track", "localise the camera of a sequence or of a live source in a map");
  auto job = std::make_shared<TrackJob>();
  auto anchor = std::make_shared<std::string>();
  auto relocalise = std::make_shared<std::string>("on");
  add_sequence_flags(command, job->sequence)
      ->description(
          "sequence: a folder in one of the known layouts, or a video; or a live source, with --camera: /dev/video0, "
          "an address (rtsp:// http:// udp:// tcp:// ...), - (a video stream on standard input), or a FIFO");
  add_map_flags(command, job->map);
  command->add_option("--method", job->method, method_names());
  command
      ->add_option("--out", job->out,
                   "folder for trajectory.txt, trajectory_live.txt, status.csv, covariance.csv, report.json")
      ->required();
  command->add_option("--frames", job->frames, frames_help);
  command
      ->add_option("--start", job->start,
                   "pose of the first image: truth, \"tx ty tz qx qy qz qw\" [m], or auto (it is looked up)")
      ->default_str("truth; live: auto");
  command->add_option("--relocalise", *relocalise, "look images up in the map when lost: on or off")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_option("--places", job->places, places_help);
  command
      ->add_option("--anchor", *anchor,
                   "align keyframes with the map's rendered image: on or off (default: on for gaussian, else off)")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_flag("--realtime", job->realtime,
                    "play at the sequence's rate: keyframes in the background, late frames are dropped (default: every "
                    "frame, same bits every time); live sources always are");
  add_live_flags(command, *job);
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
    job->live_source = live_kind(job->sequence.path) != LiveKind::none;
    check_flags_of_method(job->method, job->map, job->depth_noise);
    const TrackOutcome o = track_sequence(common, *job);
    print_outcome(*job, o);
    if (o.posed == 0) {
      throw NoResult(
          job->out + ": none of " + std::to_string(o.frames) +
          " frames posed: the map does not show what the images show, or the start pose or the camera is wrong");
    }
  });
}

}  // namespace odosplat::apps
