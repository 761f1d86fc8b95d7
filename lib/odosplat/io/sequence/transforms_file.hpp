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

/// Intrinsics as stored in a transforms.json: lengths in pixels, the principal point measured from the corner of the
/// first pixel. Values that the file does not give are not set.
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
  /// The camera in this project's convention. `size` is used if the file gives no size; fl_x takes precedence over
  /// camera_angle_x; without fl_y and camera_angle_y, fy = fx; without cx, cy the principal point is the middle of the
  /// image. Throws InputError naming the file, key and fault.
  CameraFile camera(const std::string& name, const cv::Size& size) const;
};

struct TransformsFrame {
  std::string color;  // as written, relative to the file's folder
  std::string depth;  // likewise; empty: none
  std::optional<SE3> T_world_camera;
  TransformsCamera camera;
  std::optional<double> time;  // [s] timestamp
};

/// A transforms.json as nerfstudio and instant-ngp use it.
struct TransformsFile {
  std::vector<TransformsFrame> frames;  // in order of time, else in the natural order of `color`
  double depth_scale = 1000.0;          // units of a depth image per metre (per unit length of the poses)
  std::string points;                   // ply_file_path, relative to the file's folder; empty: none

  /// The one camera of all frames (common_camera). `size` is used if the file gives no size. Throws InputError naming
  /// the file, key and fault.
  CameraFile camera(const std::string& name, const cv::Size& size) const;
};

/// Parses text; `name` stands for the file in errors.
///   Poses: transform_matrix is camera to world with x right, y up, z backward (OpenGL); poses are returned for x
///   right, y down, z forward. A frame whose transform_matrix is missing, null, or contains null or a number that is
///   not finite (parse_json_object) has no pose; at least one frame must have one.
///   World: that of the stored poses, which is also that of the points of ply_file_path. applied_transform, which
///   describes how it was derived from an older world, is checked to be a matrix of numbers and is not undone.
///   Intrinsics: those of a frame take precedence over those of the file, key by key.
///   Depth: depth_unit_scale_factor is metres per unit of the depth images (default 0.001).
///   Order: files list frames in any order (COLMAP's, shuffled). They are returned in the order in which they were
///   taken: by `timestamp` (seconds) if the frames have it, else by the natural order of their names. D-NeRF's `time`,
///   a phase in 0..1, is not a time stamp and is ignored.
/// Throws InputError(file, key or "frame N", fault): not JSON (with line and column), a key missing or of a wrong type,
/// a matrix that is not a rotation, a camera model other than pinhole with radial and tangential distortion, a
/// timestamp in only some of the frames or repeated, names with control characters.
TransformsFile parse_transforms(const std::string& name, const std::string& text);

}  // namespace odosplat
