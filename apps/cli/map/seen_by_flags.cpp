// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/map/seen_by_flags.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "apps/command/number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/core/terminal_text.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

bool is_sequence(const SequenceFlags& flags) {
  std::error_code error;
  const std::filesystem::path path(flags.path);
  return !flags.options.layout.empty() || path.extension() == ".json" || std::filesystem::is_directory(path, error);
}

DepthImage depth_or_none(const Sequence& sequence, std::size_t i) {
  try {
    return sequence.depth(i);
  } catch (const InputError& e) {
    log_warning(std::string(e.what()) + "; its depth is left out");
    return {};
  }
}

/// The camera where the depth image was taken, with it; where it was taken is not always known.
EditView depth_view(const Sequence& sequence, std::size_t i) {
  const std::optional<SE3> T_world_depth = sequence.has_depth(i) ? sequence.T_world_depth(i) : std::nullopt;
  if (!T_world_depth) return {sequence.camera(), *sequence.T_world_camera(i)};
  return {sequence.camera(), *T_world_depth, [sequence, i] { return depth_or_none(sequence, i); }};
}

std::vector<EditView> views_of_poses(const SeenByFlags& flags) {
  const SequenceFlags& s = flags.sequence;
  if (s.options.camera_file.empty()) throw InputError("--camera", "is needed for the poses of " + s.path);
  const CameraFile file = read_camera_file(s.options.camera_file);
  if (file.fy_sign < 0) {
    throw InputError(s.options.camera_file,
                     "has a negative fy: its poses are reflected; give the sequence instead of a file of poses");
  }
  const Trajectory poses = read_trajectory(s.path);
  require_near_origin(s.path, poses);
  std::vector<EditView> views;
  for (std::size_t k = 0; k < poses.size(); k += static_cast<std::size_t>(flags.every)) {
    views.push_back({file.camera, poses[k].T_world_camera});
  }
  return views;
}

}  // namespace

CLI::Option* add_seen_by_flags(CLI::App* command, SeenByFlags& flags, const std::string& what) {
  CLI::Option* seen_by =
      command->add_option("--seen-by", flags.sequence.path,
                          what +
                              ": a sequence with poses, or a file of poses (camera to world; needs --camera; "
                              "views are rendered without distortion)");
  add_layout_flags(command, flags.sequence);
  add_number(command, "--every", flags.every, {.least = 1}, "of --seen-by: use every Nth view")->needs(seen_by);
  for (const char* flag : {"--layout", "--camera", "--max-image-pixels"}) command->get_option(flag)->needs(seen_by);
  return seen_by;
}

std::vector<EditView> read_seen_by(const SeenByFlags& flags, bool with_depth) {
  if (!is_sequence(flags.sequence)) return views_of_poses(flags);
  const Sequence sequence = open_sequence(flags.sequence);
  std::vector<EditView> views;
  for (const std::size_t i : posed_frames(sequence, flags.every)) {
    views.push_back(with_depth ? depth_view(sequence, i) : EditView{sequence.camera(), *sequence.T_world_camera(i)});
  }
  return views;
}

std::string seen_by_words(const SeenByFlags& flags, std::size_t views) {
  const std::filesystem::path path(flags.sequence.path);
  const std::string name = path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
  return printable_line(name) + " (" + std::to_string(views) + (views == 1 ? " view)" : " views)");
}

}  // namespace odosplat::apps
