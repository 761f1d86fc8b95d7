// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/camera_file.hpp"
#include "odosplat/io/sequence.hpp"
#include "odosplat/io/video_reader.hpp"

namespace odosplat {

/// One frame of a sequence: where its files are.
struct FrameFiles {
  double time = 0.0;
  std::string time_text;  // empty: print with 6 decimals
  std::string color;      // full path; empty in videos
  std::string depth;      // full path; empty: none
  std::optional<SE3> T_world_camera;
  // Where the camera was when the depth image was taken, if its own stamp says so; none: as T_world_camera.
  std::optional<SE3> T_world_depth;
  double depth_time = 0.0;      // the stamp of the depth image, if depth_time_text is set
  std::string depth_time_text;  // the same as listed; empty: the colour image's
};

/// Points that a data set gives beside its poses, in the same world, and how their file is read.
struct SparsePoints {
  std::string file;  // empty: none
  PointCloud (*read)(const std::string& path) = nullptr;
};

/// What a layout's reader finds. Poses are as stored.
struct SequenceIndex {
  CameraFile camera;
  std::string camera_source;  // for errors: the camera file, or what calibration it is
  std::vector<FrameFiles> frames;
  Trajectory truth;
  SparsePoints sparse_points;
  std::shared_ptr<const VideoReader> video;  // instead of colour files
};

struct Layout {
  const char* name;
  const char* signature;  // what tells it, for errors
  bool (*matches)(const std::string& path);
  SequenceIndex (*index)(const std::string& path, const SequenceOptions& options);
};

/// In the order in which detection tries them.
const std::vector<Layout>& layouts();

bool is_tum(const std::string& path);
bool is_icl(const std::string& path);
bool is_redwood(const std::string& path);
bool is_sevenscenes(const std::string& path);
bool is_replica(const std::string& path);
bool is_colmap(const std::string& path);
bool is_nerfstudio(const std::string& path);
/// True for a file NAME.json, which is no video.
bool is_transforms(const std::string& path);
bool is_image_folder(const std::string& path);
bool is_video(const std::string& path);
SequenceIndex index_tum(const std::string& path, const SequenceOptions& options);
SequenceIndex index_icl(const std::string& path, const SequenceOptions& options);
SequenceIndex index_redwood(const std::string& path, const SequenceOptions& options);
SequenceIndex index_sevenscenes(const std::string& path, const SequenceOptions& options);
SequenceIndex index_replica(const std::string& path, const SequenceOptions& options);
SequenceIndex index_colmap(const std::string& path, const SequenceOptions& options);
SequenceIndex index_nerfstudio(const std::string& path, const SequenceOptions& options);
SequenceIndex index_image_folder(const std::string& path, const SequenceOptions& options);
SequenceIndex index_video(const std::string& path, const SequenceOptions& options);

// Shared by the readers.

constexpr double default_fps = 30.0;
constexpr double same_stamp = 1e-6;  // [s] stamps this near are one

std::string join(const std::string& folder, const std::string& name);
/// The file that a list names, relative to the list's folder. Backslashes are folders if only so there is such a file
/// (lists made on Windows).
std::string listed_file(const std::string& folder, const std::string& written);
bool file_exists(const std::string& path);
/// Lower-case extension with its dot (".png").
std::string extension_of(const std::string& name);
bool is_image_name(const std::string& name);

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
