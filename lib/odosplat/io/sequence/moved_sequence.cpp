// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/moved_sequence.hpp"

#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/text_words.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

std::string listed_path(const std::string& file) {
  std::string path = fs::absolute(file).lexically_normal().string();
  if (has_control_characters(path) || trimmed(path) != path) {
    throw InputError(file, "its name cannot be written into a list");
  }
  return path;
}

// Removes a list that is not wanted, because an earlier run may have left one.
void write_or_remove(const std::string& path, bool wanted, const std::string& text) {
  std::error_code ignored;
  if (wanted) {
    write_file_atomically(path, text);
  } else {
    fs::remove(path, ignored);
  }
}

}  // namespace

std::size_t write_moved_sequence(const std::string& folder, const Sequence& sequence, const Similarity& moved) {
  std::string colors = "# time file\n";
  std::string depths = colors;
  std::string exposures = "# time exposure\n";
  std::size_t frames = 0;
  bool any_depth = false;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (!sequence.T_world_camera(i)) continue;
    if (sequence.color_file(i).empty()) throw InputError(sequence.name(), "is a video: its frames are no files");
    colors += sequence.time_text(i) + " " + listed_path(sequence.color_file(i)) + "\n";
    exposures += sequence.time_text(i) + " " + std::to_string(sequence.exposure(i)) + "\n";
    ++frames;
    if (!sequence.has_depth(i)) continue;
    any_depth = true;
    depths += sequence.depth_time_text(i) + " " + listed_path(sequence.depth_file(i)) + "\n";
  }
  if (frames == 0) throw InputError(sequence.name(), "no frame has a pose");
  Trajectory truth = sequence.listed_poses();
  for (StampedPose& pose : truth) pose.T_world_camera = moved * pose.T_world_camera;
  CameraFile camera = sequence.camera_file();
  camera.depth_scale /= moved.scale;
  if (camera.depth_camera) {
    SE3& T = camera.depth_camera->T_color_depth;
    T = SE3(T.rotation(), moved.scale * T.translation());
  }
  if (!camera.vignette.empty()) camera.vignette = listed_path(camera.vignette);
  check_camera(join(folder, "camera.yaml"), camera);
  const MadeFolders made = ensure_output_folder(folder);
  write_camera_file(join(folder, "camera.yaml"), camera);
  write_trajectory(join(folder, "groundtruth.txt"), truth);
  write_or_remove(join(folder, "depth.txt"), any_depth, depths);
  write_or_remove(join(folder, "exposures.txt"), sequence.has_exposures(), exposures);
  write_file_atomically(join(folder, "rgb.txt"), colors);
  return frames;
}

}  // namespace odosplat
