// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/sequence/sequence_options.hpp"

// What the readers of several layouts share.
namespace odosplat {

/// A calibration that a layout's authors publish.
CameraFile published_camera(int width, int height, double fx, double fy, double cx, double cy, double depth_scale);

/// The camera that counts: --camera, else camera.yaml in one of the folders, else the published one; InputError if
/// there is none. A file that names no depth_scale gets `published`'s, or `depth_scale` without one.
void choose_camera(const SequenceOptions& options, const std::vector<std::string>& folders,
                   const std::optional<CameraFile>& published, const std::string& published_name, double depth_scale,
                   SequenceIndex& index);

/// What a layout without times holds, by frame number.
struct NumberedFiles {
  std::map<long long, std::string> color;
  std::map<long long, std::string> depth;
  std::map<long long, SE3> poses;
};

/// Poses of a file whose times are frame numbers. InputError if one is not a whole number.
std::map<long long, SE3> read_numbered_poses(const std::string& path);

/// Warns once if some of the frames, not all, have no pose; `place` is the file or folder that should give them.
void warn_without_pose(const std::string& place, std::size_t without, std::size_t frames);

/// Frames are the colour images in the order of their numbers, with the depth and the pose of the same number; truth is
/// every pose. Times are number / fps, fps from index.camera or 30.
void fill_numbered(const NumberedFiles& files, SequenceIndex& index);

/// Pose at time t [s]: the one of equal stamp (same_stamp); else between the two around t if they are at most
/// 0.1 s apart; else the nearest within 0.01 s; else none.
std::optional<SE3> pose_at(const Trajectory& trajectory, double t);

}  // namespace odosplat
