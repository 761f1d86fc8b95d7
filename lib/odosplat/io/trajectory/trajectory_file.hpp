// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat {

/// Poses of a file, T_world_camera, in order of time. Two poses may have one stamp: public ground truth has such lines.
/// The format is told by the number of values a line:
///   8   TUM: time tx ty tz qx qy qz qw (quaternions need not be of unit length)
///   17, or 8 with times in whole nanoseconds   EuRoC's table, see euroc_csv.hpp; times become seconds
///   12  KITTI: the upper 3x4 of the matrix, row by row; the times are in `times_path`, one a line, or 0, 1, 2, ...
///   16  a whole 4x4 matrix a line (Replica), times as for 12
///   4   three rows of four a pose (ICL-NUIM gt.sim), times 0, 1, 2, ...
///   3 then 4 x 4   Redwood's log: "i j k" and four rows of four; time = i
/// Lines that start with # and empty lines are skipped; values are separated by blanks, tabs or commas. A pose with a
/// value that is not finite is none, as trackers write it where they were lost: it is left out, one warning tells how
/// many, and poses without times keep their numbers.
/// Throws InputError(file, "line N", fault): a value that is no number, a time that is not finite, too few or too many
/// values, a quaternion of length zero, a matrix that is no rotation, a time that goes back. A file without poses:
/// InputError.
Trajectory read_trajectory(const std::string& path, const std::string& times_path = "");

/// What the times of a file's poses are.
enum class StampKind {
  times,          // as the file or a second file gives them
  frame_numbers,  // of a file without times: a Redwood log's own numbers
  line_numbers    // of a file without times: 0, 1, 2, ... in the order of its poses
};

/// The same from text; `name` stands for the file in errors.
Trajectory parse_trajectory(const std::string& name, const std::string& text);

/// The same with what the file says of the times, and of the poses that were left out.
struct PoseFile {
  Trajectory poses;
  StampKind stamps = StampKind::times;
  std::vector<std::size_t> numbers;        // of each pose: how many the file lists before it
  std::vector<double> times_without_pose;  // in order of time
};
PoseFile read_pose_file(const std::string& path, const std::string& times_path = "");
PoseFile parse_pose_file(const std::string& name, const std::string& text);

/// A single pose as four rows of four values (7-Scenes); none if a value is not finite or the file holds no values.
/// Errors as above.
std::optional<SE3> read_pose_matrix(const std::string& path);
std::optional<SE3> parse_pose_matrix(const std::string& name, const std::string& text);

/// Pose of the first 12 values of a 3x4 or 4x4 matrix, row by row, all finite: with the rotation nearest to the one
/// written; none if the matrix is no rotation within the digits that files carry.
std::optional<SE3> pose_from_rows(const std::vector<double>& rows);

/// TUM format, 9 decimals, stamps as StampedPose::stamp(); written beside and renamed. An empty trajectory gives a file
/// with a comment line only.
void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      Durability durability = Durability::synced);

}  // namespace odosplat
