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

// Functions shared by the readers of several layouts.
namespace odosplat {

/// A camera from a calibration that a data set's authors publish.
CameraFile published_camera(int width, int height, double fx, double fy, double cx, double cy, double depth_scale);

/// Sets the camera of `index`: the file of --camera, else camera.yaml in one of the folders, else the published one;
/// InputError if there is none. A file without depth_scale gets that of `published`, or `depth_scale` if there is no
/// published camera.
void choose_camera(const SequenceOptions& options, const std::vector<std::string>& folders,
                   const std::optional<CameraFile>& published, const std::string& published_name, double depth_scale,
                   SequenceIndex& index);

/// The contents of a layout without times, by frame number.
struct NumberedFiles {
  std::map<long long, std::string> color;
  std::map<long long, std::string> depth;
  std::map<long long, SE3> poses;
};

/// Poses of a file whose times are frame numbers. Throws InputError if one is not a whole number.
std::map<long long, SE3> read_numbered_poses(const std::string& path);

/// Logs one warning if some but not all frames have no pose; `place` is the file or folder that should give them.
void warn_without_pose(const std::string& place, std::size_t without, std::size_t frames);

/// Fills frames and truth of `index`. Frames are the colour images in the order of their numbers, with the depth and
/// the pose of the same number; truth is every pose. Times are number / fps, with fps from index.camera or 30.
void fill_numbered(const NumberedFiles& files, SequenceIndex& index);

/// Pose at time t [s]: the one with an equal stamp (same_stamp); else interpolated between the two poses around t if
/// these are at most 0.1 s apart; else the nearest within 0.01 s; else none.
std::optional<SE3> pose_at(const Trajectory& trajectory, double t);

}  // namespace odosplat
