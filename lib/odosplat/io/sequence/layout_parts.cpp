// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/layout_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {
namespace {

constexpr double largest_bracket = 0.1;  // [s]
constexpr double nearest_pose = 0.01;    // [s]

}  // namespace

void warn_without_pose(const std::string& place, std::size_t without, std::size_t frames) {
  if (without == 0 || without == frames) return;
  log_warning(place + ": " + std::to_string(without) + " of " + std::to_string(frames) +
              " frames have no pose, or one that is not finite");
}

CameraFile published_camera(int width, int height, double fx, double fy, double cx, double cy, double depth_scale) {
  CameraFile file;
  file.camera = {width, height, fx, std::abs(fy), cx, cy};
  file.fy_sign = fy < 0.0 ? -1 : 1;
  file.depth_scale = depth_scale;
  file.has_depth_scale = true;
  file.fps = default_fps;
  return file;
}

void choose_camera(const SequenceOptions& options, const std::vector<std::string>& folders,
                   const std::optional<CameraFile>& published, const std::string& published_name, double depth_scale,
                   SequenceIndex& index) {
  std::string file = options.camera_file;
  for (const std::string& folder : folders) {
    const std::string candidate = join(folder, "camera.yaml");
    if (file.empty() && file_exists(candidate)) file = candidate;
  }
  if (!file.empty()) {
    index.camera = read_camera_file(file);
    index.camera_source = file;
    if (!index.camera.has_depth_scale) index.camera.depth_scale = published ? published->depth_scale : depth_scale;
  } else if (published) {
    index.camera = *published;
    index.camera_source = published_name;
  } else {
    throw InputError(folders.front(), "has no camera.yaml; name a camera file (--camera)");
  }
}

std::map<long long, SE3> read_numbered_poses(const std::string& path) {
  std::map<long long, SE3> poses;
  for (const StampedPose& pose : read_trajectory(path)) {
    if (pose.time != std::floor(pose.time) || std::abs(pose.time) > 1e15) {
      throw InputError(path, "the stamp " + pose.stamp() + " is not a frame number");
    }
    poses[static_cast<long long>(pose.time)] = pose.T_world_camera;
  }
  return poses;
}

void fill_numbered(const NumberedFiles& files, SequenceIndex& index) {
  const double fps = index.camera.fps > 0.0 ? index.camera.fps : default_fps;
  if (index.camera.fps <= 0.0) {
    log_info(index.camera_source + " has no fps: 30 frames per second are assumed");
  }
  for (const auto& [number, color] : files.color) {
    FrameFiles frame;
    frame.time = static_cast<double>(number) / fps;
    frame.color = color;
    if (const auto depth = files.depth.find(number); depth != files.depth.end()) frame.depth = depth->second;
    if (const auto pose = files.poses.find(number); pose != files.poses.end()) frame.T_world_camera = pose->second;
    index.frames.push_back(std::move(frame));
  }
  for (const auto& [number, pose] : files.poses) index.truth.push_back({static_cast<double>(number) / fps, pose, ""});
}

std::optional<SE3> pose_at(const Trajectory& trajectory, double t) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), t,
                                      [](const StampedPose& pose, double time) { return pose.time < time; });
  const StampedPose* next = after == trajectory.end() ? nullptr : &*after;
  const StampedPose* last = after == trajectory.begin() ? nullptr : &*(after - 1);
  const StampedPose* nearest = next;
  if (next == nullptr || (last != nullptr && t - last->time <= next->time - t)) nearest = last;
  if (nearest == nullptr) return std::nullopt;
  const double distance = std::abs(nearest->time - t);
  if (distance <= same_stamp) return nearest->T_world_camera;
  // Poses at 10 Hz are 0.1 s apart but for rounding.
  if (last != nullptr && next != nullptr && next->time - last->time <= largest_bracket + same_stamp) {
    return pose_between(*last, *next, t);
  }
  if (distance <= nearest_pose) return nearest->T_world_camera;
  return std::nullopt;
}

}  // namespace odosplat
