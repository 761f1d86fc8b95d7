// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/io/camera/camera_file.hpp"

namespace odosplat {

/// Intrinsics as a transforms.json has them: lengths in pixels, the principal point counted from the corner of the
/// first pixel. What the file does not say is not set.
struct TransformsCamera {
  std::optional<double> width;
  std::optional<double> height;
  std::optional<double> fl_x;
  std::optional<double> fl_y;
  std::optional<double> angle_x;  // [rad] full angle of view
  std::optional<double> angle_y;
  std::optional<double> cx;
  std::optional<double> cy;
  std::vector<double> distortion;  // k1 k2 p1 p2 k3, empty if all are 0

  bool operator==(const TransformsCamera&) const = default;

  /// True if the file gives the size of the images.
  bool has_size() const { return width && height; }
  /// In our convention. `size` counts where the file gives none; fl_x counts before camera_angle_x; without fl_y and
  /// camera_angle_y fy = fx; without cx, cy the middle of the image. InputError naming the file, key and fault.
  CameraFile camera(const std::string& name, const cv::Size& size) const;
};

struct TransformsFrame {
  std::string color;  // as written, relative to the file's folder
  std::string depth;  // the same; empty: none
  std::optional<SE3> T_world_camera;
  TransformsCamera camera;
  std::optional<double> time;  // [s] timestamp
};

/// A transforms.json as nerfstudio and instant-ngp use it.
struct TransformsFile {
  std::vector<TransformsFrame> frames;  // in order of time, else in the natural order of `color`
  double depth_scale = 1000.0;          // units of a depth image a metre (of the poses)
  std::string points;                   // ply_file_path, relative to the file's folder; empty: none

  /// The one camera of all frames (common_camera). `size` counts where the file gives none. InputError naming the file,
  /// key and fault.
  CameraFile camera(const std::string& name, const cv::Size& size) const;
};

/// Reads text; `name` stands for the file in errors. transform_matrix is camera to world with x right, y up, z backward
/// (OpenGL); poses are returned for x right, y down, z forward. The world is the one of the stored poses, in which the
/// points of ply_file_path are as well: applied_transform, which says how that world came from an older one, is held to
/// be a matrix of numbers and not undone. Intrinsics of a frame count before those of the file, key by key.
/// depth_unit_scale_factor is metres a unit of the depth images (0.001 if not said). A frame whose transform_matrix is
/// missing, null, or holds null or a number that is not finite (parse_json_object) has no pose; one frame at least must
/// have one.
/// Files list their frames in any order (COLMAP's, shuffled): they are returned in the order in which they were taken,
/// by `timestamp` (seconds) if the frames have it, else by the natural order of their names. D-NeRF's `time`, a phase
/// in 0..1, is no stamp and not looked at.
/// InputError(file, key or "frame N", fault): no JSON (with line and column), a key missing or of another kind, no
/// rotation, a camera model that is not pinhole with radial and tangential distortion, a timestamp in some of the
/// frames only or twice the same, names with control characters.
TransformsFile parse_transforms(const std::string& name, const std::string& text);

}  // namespace odosplat
