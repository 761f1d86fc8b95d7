// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Poses of a file, T_world_camera, in order of time. Two poses may have one stamp: public ground truth has such lines.
/// The format is told by the number of values a line:
///   8   TUM: time tx ty tz qx qy qz qw (quaternions need not be of unit length)
///   17, or 8 with times in whole nanoseconds   EuRoC's table, see euroc_csv.hpp; times become seconds
///   12  KITTI: the upper 3x4 of the matrix, row by row; the times are in `times_path`, one a line, or 0, 1, 2, ...
///   16  a whole 4x4 matrix a line (Replica), times as for 12
///   4   three rows of four a pose (ICL-NUIM gt.sim), times 0, 1, 2, ...
///   3 then 4 x 4   Redwood's log: "i j k" and four rows of four; time = i
/// Lines that start with # and empty lines are skipped; values are separated by blanks, tabs or commas.
/// Throws InputError(file, "line N", fault): a value that is no number, NaN or infinite, too few or too many values, a
/// quaternion of length zero, a matrix that is no rotation, a time that goes back. A file without poses:
/// InputError.
Trajectory read_trajectory(const std::string& path, const std::string& times_path = "");
/// What the times of a file's poses are.
enum class StampKind {
  times,          // as the file or a second file gives them
  frame_numbers,  // of a file without times: a Redwood log's own numbers
  line_numbers    // of a file without times: 0, 1, 2, ... in the order of its poses
};

/// The poses of a file with what their times are.
struct PoseFile {
  Trajectory poses;
  StampKind stamps = StampKind::times;
};
PoseFile read_pose_file(const std::string& path, const std::string& times_path = "");
PoseFile parse_pose_file(const std::string& name, const std::string& text);

/// The same from text; `name` stands for the file in errors.
Trajectory parse_trajectory(const std::string& name, const std::string& text);

/// A single pose as four rows of four values (7-Scenes). Errors as above.
SE3 read_pose_matrix(const std::string& path);
SE3 parse_pose_matrix(const std::string& name, const std::string& text);

/// Pose of the first 12 values of a 3x4 or 4x4 matrix, row by row, all finite: with the rotation nearest to the one
/// written; none if the matrix is no rotation within the digits that files carry.
std::optional<SE3> pose_from_rows(const std::vector<double>& rows);

/// TUM format, 9 decimals, stamps as StampedPose::stamp(); written beside and renamed. An empty trajectory gives a file
/// with a comment line only.
void write_trajectory(const std::string& path, const Trajectory& trajectory);

}  // namespace odosplat
