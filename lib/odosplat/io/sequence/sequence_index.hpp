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
constexpr double same_stamp = 1e-6;  // [s] stamps this near are one

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

}  // namespace odosplat
