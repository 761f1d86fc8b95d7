// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/video/video_reader.hpp"

namespace odosplat {

constexpr double default_fps = 30.0;
constexpr double same_stamp = 1e-6;  // [s] stamps that differ by no more than this are equal

/// The files, time and pose of one frame of a sequence.
struct FrameFiles {
  double time = 0.0;
  std::string time_text;  // empty: print with 6 decimals
  std::string color;      // full path; empty in videos
  std::string depth;      // full path; empty: none
  std::optional<SE3> T_world_camera;
  // Pose at the time of the depth image if that has a stamp of its own; none: see Sequence::T_world_depth.
  std::optional<SE3> T_world_depth;
  double depth_time = 0.0;      // the stamp of the depth image, if depth_time_text is set
  std::string depth_time_text;  // the same as written in the list; empty: the colour image's stamp applies
};

/// Sparse points that a data set provides in the world of its poses, and the function that reads their file.
struct SparsePoints {
  std::string file;  // empty: none
  PointCloud (*read)(const std::string& path) = nullptr;
};

/// The result of a layout's reader. Poses are as stored, not reflected.
struct SequenceIndex {
  CameraFile camera;
  std::string camera_source;  // for errors: the camera file or the name of the published calibration
  std::vector<FrameFiles> frames;
  Trajectory truth;
  // Whether the frames' poses were looked up in `truth` by time, with the camera's time offsets. Else a frame's pose is
  // the one that the data set gives with the image: that at its stamp, without an offset.
  bool poses_by_time = false;
  SparsePoints sparse_points;
  std::shared_ptr<const VideoReader> video;  // instead of colour files
};

}  // namespace odosplat
