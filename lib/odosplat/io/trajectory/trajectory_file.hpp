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

/// Poses of a file, T_world_camera, in order of time. Two poses may have the same stamp, as in some public ground
/// truth. The format is recognised by the number of values per line:
///   8   TUM: time tx ty tz qx qy qz qw (quaternions need not be of unit length)
///   17, or 8 with times in whole nanoseconds   EuRoC's table, see euroc_csv.hpp; times become seconds
///   12  KITTI: the upper 3x4 of the matrix, row by row; the times are in `times_path`, one per line, or 0, 1, 2, ...
///   16  a whole 4x4 matrix per line (Replica), times as for 12
///   4   three rows of four per pose (ICL-NUIM gt.sim), times 0, 1, 2, ...
///   3 then 4 x 4   Redwood's log: "i j k" and four rows of four; time = i
/// Lines that start with # and empty lines are skipped; values are separated by blanks, tabs or commas. A pose with a
/// value that is not finite, as trackers write it for frames without a result, is left out; one warning gives the
/// number of such poses. In a file without times the remaining poses keep their numbers.
/// Throws InputError(file, "line N", fault): a value that is not a number, a time that is not finite, too few or too
/// many values, a quaternion of length zero, a matrix that is not a rotation, a time before the previous one. Throws
/// InputError also for a file without poses.
Trajectory read_trajectory(const std::string& path, const std::string& times_path = "");

/// The meaning of the times of a file's poses.
enum class StampKind {
  times,          // from the file or from a second file
  frame_numbers,  // the file has no times, but numbers of frames (Redwood's log)
  line_numbers    // the file has no times: 0, 1, 2, ... in the order of its poses
};

/// The same from text; `name` stands for the file in errors.
Trajectory parse_trajectory(const std::string& name, const std::string& text);

/// The poses of a file, with the kind of its times and the poses that were left out.
struct PoseFile {
  Trajectory poses;
  StampKind stamps = StampKind::times;
  std::vector<std::size_t> numbers;        // for each pose, the number of poses that the file lists before it
  std::vector<double> times_without_pose;  // in order of time
};
PoseFile read_pose_file(const std::string& path, const std::string& times_path = "");
PoseFile parse_pose_file(const std::string& name, const std::string& text);

/// A single pose as four rows of four values (7-Scenes); none if a value is not finite or the file has no values.
/// Errors as above.
std::optional<SE3> read_pose_matrix(const std::string& path);
std::optional<SE3> parse_pose_matrix(const std::string& name, const std::string& text);

/// Pose from the first 12 values of a 3x4 or 4x4 matrix, row by row, all finite. The rotation is the nearest to the
/// given matrix, which files round; none if the matrix is not a rotation within the rounding of files.
std::optional<SE3> pose_from_rows(const std::vector<double>& rows);

/// Writes TUM format with 9 decimals and stamps as StampedPose::stamp(), through AtomicFile. An empty trajectory gives
/// a file with only a comment line.
void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      Durability durability = Durability::synced);

}  // namespace odosplat
