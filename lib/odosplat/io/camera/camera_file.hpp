// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/camera/camera_entries.hpp"

namespace odosplat {

/// Reads a camera.yaml, or a camera file of OpenCV, ROS (camera_info), Kalibr or EuRoC (read_camera_of_others), which may
/// hold depth_scale, fps, time_offset, line_time, gamma, vignette and depth_camera, too; what else it holds is ignored.
/// Throws InputError(file, key, fault): a key missing, unknown or given twice, a value that is not a number or not
/// finite, several YAML documents, a number of distortion coefficients other than 4 or 5, a T_color_depth
/// without rotation, and everything that check_camera refuses; when reading from a path also if the vignette's file does not exist.
CameraFile read_camera_file(const std::string& path);
/// The same from text; `name` stands for the file in errors.
CameraFile parse_camera_file(const std::string& name, const std::string& text);

/// Writes width .. cy, depth_scale and the other values that are set; numbers are written so that reading restores the
/// same bits (a rotation and line_time: to rounding). Throws InputError if the path cannot be written.
void write_camera_file(const std::string& path, const CameraFile& file);

}  // namespace odosplat
