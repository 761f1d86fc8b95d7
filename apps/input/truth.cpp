// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/truth.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/trajectory/comparable_stamps.hpp"

namespace odosplat::apps {
namespace {

constexpr double rounding = 1e-6;  // [s] of time stamps with six decimals

struct Truth {
  PoseFile file;
  std::optional<TimeSpan> span;
  std::vector<double> frame_times;  // of a sequence's images
};

bool is_sequence(const TruthFlags& flags) {
  std::error_code error;
  const std::filesystem::path path(flags.sequence.path);
  return !flags.sequence.options.layout.empty() || path.extension() == ".json" ||
         std::filesystem::is_directory(path, error);
}

Truth truth_of_sequence(const TruthFlags& flags) {
  if (!flags.times.empty())
    throw InputError("--truth-times", "is for a file, " + flags.sequence.path + " is a sequence");
  const Sequence sequence = open_sequence(flags.sequence);
  FrameRange range = flags.frames.empty() ? FrameRange() : parse_frames(flags.frames);
  range.end = std::min(range.end, sequence.size());
  if (range.begin >= range.end) {
    throw InputError("--frames", "is " + flags.frames + ", the sequence has " + std::to_string(sequence.size()));
  }
  Truth truth;
  truth.span = TimeSpan{sequence.time(range.begin), sequence.time(range.end - 1)};
  for (std::size_t i = range.begin; i < range.end; ++i) truth.frame_times.push_back(sequence.time(i));
  for (const StampedPose& pose : sequence.truth()) {
    const bool inside = pose.time >= truth.span->first - rounding && pose.time <= truth.span->last + rounding;
    if (flags.frames.empty() || inside) truth.file.poses.push_back(pose);
  }
  if (truth.file.poses.empty()) {
    throw InputError(flags.sequence.path,
                     "has no true poses" + std::string(flags.frames.empty() ? "" : " in --frames"));
  }
  return truth;
}

Truth read_truth(const TruthFlags& flags) {
  if (flags.sequence.path.empty()) return {};
  if (is_sequence(flags)) return truth_of_sequence(flags);
  if (!flags.frames.empty())
    throw InputError("--frames", "needs a sequence as --truth, " + flags.sequence.path + " is a file");
  return {read_pose_file(flags.sequence.path, flags.times), {}, {}};
}

/// Gives poses without times the times of the sequence's images, in order, if their number is the same.
void take_times_of_frames(const std::string& name, const std::vector<double>& times, PoseFile& file) {
  const std::size_t count = file.poses.size() + file.times_without_pose.size();
  if (file.stamps != StampKind::line_numbers || times.empty() || count != times.size()) return;
  log_info(name + ": has no times; its " + std::to_string(count) + " poses are taken for those of the " +
           std::to_string(count) + " images, in order");
  const auto time_of = [&times](double number) { return times.at(static_cast<std::size_t>(number)); };
  for (StampedPose& pose : file.poses) pose = {time_of(pose.time), pose.T_world_camera, ""};
  for (double& time : file.times_without_pose) time = time_of(time);
  file.stamps = StampKind::times;
}

// Times of the first and the last image in status.csv, which `track` writes beside its trajectory.
std::optional<TimeSpan> span_of_run(const std::string& estimate) {
  std::ifstream table(std::filesystem::path(estimate).parent_path() / "status.csv");
  std::string line;
  if (!std::getline(table, line) || line.rfind("time,status,", 0) != 0) return std::nullopt;
  std::optional<TimeSpan> span;
  while (std::getline(table, line)) {
    char* end = nullptr;
    const double time = std::strtod(line.c_str(), &end);
    if (end == line.c_str() || *end != ',') return std::nullopt;
    if (!span) span = TimeSpan{time, time};
    span->last = time;
  }
  return span;
}

}  // namespace

CLI::Option* add_truth_flags(CLI::App* command, TruthFlags& flags) {
  CLI::Option* truth = command->add_option(
      "--truth", flags.sequence.path, "true trajectory: a file of poses, or a sequence in any of the known layouts");
  command->add_option("--truth-times", flags.times, "times of the truth, one a line, for formats without times");
  add_layout_flags(command, flags.sequence);
  command->add_option("--frames", flags.frames, std::string("of a sequence as --truth: ") + frames_help);
  return truth;
}

JudgedTrajectory read_judged(const std::string& estimate, const std::string& estimate_times, const TruthFlags& flags) {
  PoseFile estimated = read_pose_file(estimate, estimate_times);
  Truth truth = read_truth(flags);
  take_times_of_frames(estimate, truth.frame_times, estimated);
  if (!flags.sequence.path.empty()) {
    require_comparable_stamps({estimated, estimate, "--times"}, {truth.file, flags.sequence.path, "--truth-times"});
  }
  std::optional<TimeSpan> span = span_of_run(estimate);
  if (span && truth.span) {
    span = TimeSpan{std::max(span->first, truth.span->first), std::min(span->last, truth.span->last)};
  } else if (!span) {
    span = truth.span;
  }
  return {std::move(estimated.poses), std::move(truth.file.poses), span};
}

Trajectory read_true_poses(const TruthFlags& truth) { return read_truth(truth).file.poses; }

}  // namespace odosplat::apps
