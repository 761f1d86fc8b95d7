// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// TUM RGB-D benchmark (Sturm et al., IROS 2012) and ICL-NUIM's PNG archive (Handa et al., ICRA 2014).
#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/stamp_guess.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/list_file.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {
namespace {

constexpr double tum_depth_scale = 5000.0;
constexpr double tum_depth_tolerance = 0.02;  // [s]

bool has_time(const std::vector<double>& times, double time) {
  return std::any_of(times.begin(), times.end(), [time](double t) { return std::abs(t - time) <= same_stamp; });
}

std::vector<double> times_of(const std::vector<ListedImage>& list) {
  std::vector<double> times;
  times.reserve(list.size());
  for (const ListedImage& image : list) times.push_back(image.time);
  return times;
}

// Frames from rgb.txt, and from depth.txt if it exists.
std::vector<FrameFiles> frames_of_lists(const std::string& path) {
  const std::string color_list = join(path, "rgb.txt");
  const std::vector<ListedImage> colors = parse_image_list(color_list, read_file(color_list));
  if (colors.empty()) throw InputError(color_list, "lists no image");
  std::vector<FrameFiles> frames(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    frames[i].time = colors[i].time;
    frames[i].time_text = colors[i].time_text;
    frames[i].color = listed_file(path, colors[i].path);
  }
  const std::string depth_list = join(path, "depth.txt");
  if (!file_exists(depth_list)) return frames;
  const std::vector<ListedImage> depths = parse_image_list(depth_list, read_file(depth_list));
  for (const auto& [i, j] : associate_by_time(times_of(colors), times_of(depths), tum_depth_tolerance)) {
    frames[i].depth = listed_file(path, depths[j].path);
    frames[i].depth_time = depths[j].time;
    frames[i].depth_time_text = depths[j].time_text;
  }
  return frames;
}

// Frames from associations.txt: the pairs that TUM's associate.py makes from both lists.
std::vector<FrameFiles> frames_of_pairs(const std::string& path) {
  const std::string list = join(path, "associations.txt");
  const std::vector<ListedPair> pairs = parse_pair_list(list, read_file(list));
  if (pairs.empty()) throw InputError(list, "lists no image");
  std::vector<FrameFiles> frames(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    frames[i].time = pairs[i].color_id;
    frames[i].time_text = pairs[i].color_text;
    frames[i].color = listed_file(path, pairs[i].color_path);
    frames[i].depth = listed_file(path, pairs[i].depth_path);
    frames[i].depth_time = pairs[i].depth_id;
    frames[i].depth_time_text = pairs[i].depth_text;
  }
  return frames;
}

bool has_icl_poses(const std::string& path) {
  const std::vector<std::string> names = list_folder(path);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.ends_with(".gt.freiburg") || name.ends_with(".gt.sim");
  });
}

bool has_pairs_with_times(const std::string& path) {
  const std::string list = join(path, "associations.txt");
  if (!file_exists(list) || has_icl_poses(path)) return false;
  try {
    const std::vector<ListedPair> pairs = parse_pair_list(list, read_file(list));
    return std::any_of(pairs.begin(), pairs.end(), [](const ListedPair& pair) { return pair.has_times(); });
  } catch (const InputError&) {
    return false;  // the reader of associations.txt reports the fault
  }
}

// The only file with that ending; empty if there is none.
std::string only_file_ending(const std::string& folder, const std::string& ending) {
  std::string found;
  for (const std::string& name : list_folder(folder)) {
    if (!name.ends_with(ending)) continue;
    if (!found.empty()) throw InputError(folder, "holds more than one *" + ending);
    found = join(folder, name);
  }
  return found;
}

std::map<long long, SE3> icl_poses(const std::string& folder) {
  const std::string freiburg = only_file_ending(folder, ".gt.freiburg");
  if (!freiburg.empty()) return read_numbered_poses(freiburg);
  const std::string sim = only_file_ending(folder, ".gt.sim");
  std::map<long long, SE3> poses;
  if (sim.empty()) return poses;
  // gt.sim has the same poses without their numbers, which start at 1.
  for (const auto& [number, pose] : read_numbered_poses(sim)) poses[number + 1] = pose;
  return poses;
}

// Warns if no image gets a pose, which usually means that the stamps of images and poses are in different units.
void warn_if_unposed(const std::string& truth, const SequenceIndex& index) {
  if (index.truth.empty()) return;
  const double offset = index.camera.time_offset;
  NamedStamps images{offset == 0.0 ? "the images" : "the images (with time_offset)", {}};
  for (const FrameFiles& frame : index.frames) {
    if (frame.T_world_camera) return;
    images.times.push_back(frame.time + offset);
  }
  NamedStamps poses{"the poses", {}};
  for (const StampedPose& pose : index.truth) poses.times.push_back(pose.time);
  log_warning(truth + ": none of its poses matches an image in time; " +
              guess_stamp_fault(images, poses, tum_depth_tolerance));
}

}  // namespace

bool is_tum(const std::string& path) { return file_exists(join(path, "rgb.txt")) || has_pairs_with_times(path); }
bool is_icl(const std::string& path) { return file_exists(join(path, "associations.txt")); }

SequenceIndex index_tum(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  const bool has_lists = file_exists(join(path, "rgb.txt")) || !has_pairs_with_times(path);
  index.frames = has_lists ? frames_of_lists(path) : frames_of_pairs(path);
  choose_camera(options, {path}, std::nullopt, "", tum_depth_scale, index);
  const std::string truth = join(path, "groundtruth.txt");
  if (!file_exists(truth)) return index;
  const PoseFile poses = read_pose_file(truth);
  index.truth = poses.poses;
  index.poses_by_time = true;
  const double offset = index.camera.time_offset;
  const double depth_offset = index.camera.depth_time_offset();
  for (FrameFiles& frame : index.frames) {
    // No interpolation at a stamp for which the file explicitly has an invalid pose. With an offset the image's own
    // stamp counts too: else poses around it would be interpolated over the invalid one.
    if (has_time(poses.times_without_pose, frame.time)) continue;
    if (offset != 0.0 && has_time(poses.times_without_pose, frame.time + offset)) continue;
    frame.T_world_camera = pose_at(index.truth, frame.time + offset);
    if (!frame.depth.empty()) frame.T_world_depth = pose_at(index.truth, frame.depth_time + depth_offset);
  }
  warn_if_unposed(truth, index);
  return index;
}

SequenceIndex index_icl(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  const std::string list = join(path, "associations.txt");
  const std::vector<ListedPair> pairs = parse_pair_list(list, read_file(list));
  if (pairs.empty()) throw InputError(list, "lists no image");
  const CameraFile published = published_camera(640, 480, 481.2, -480.0, 319.5, 239.5, 5000.0);
  choose_camera(options, {path}, published, "the published camera of ICL-NUIM", published.depth_scale, index);
  NumberedFiles files;
  for (const ListedPair& pair : pairs) {
    if (pair.color_id != std::floor(pair.color_id) || std::abs(pair.color_id) > 1e15) {
      throw InputError(list, "line " + std::to_string(pair.line), "the id is not a frame number");
    }
    const auto number = static_cast<long long>(pair.color_id);
    files.color[number] = listed_file(path, pair.color_path);
    files.depth[number] = listed_file(path, pair.depth_path);
  }
  files.poses = icl_poses(path);
  fill_numbered(files, index);
  return index;
}

}  // namespace odosplat
