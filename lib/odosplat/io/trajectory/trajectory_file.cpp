// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/trajectory_file.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/text/text_words.hpp"
#include "odosplat/io/trajectory/euroc_csv.hpp"

namespace odosplat {
namespace {

struct Line {
  std::size_t number = 0;  // from 1
  std::vector<double> values;
  std::string first;  // first value as written
};

class Lines {
 public:
  Lines(std::string name, const std::string& text) : name_(std::move(name)) {
    std::string_view rest = without_byte_order_mark(name_, text);
    for (std::size_t number = 1; !rest.empty(); ++number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      add(number, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  const std::vector<Line>& all() const { return lines_; }
  const std::string& name() const { return name_; }

  [[noreturn]] void fail(const Line& line, const std::string& fault) const {
    throw InputError(name_, "line " + std::to_string(line.number), fault);
  }
  /// The first value of a line, which is a time or a frame number.
  double stamp(const Line& line) const {
    if (!std::isfinite(line.values[0])) fail(line, shown(line.first) + " is not finite");
    return line.values[0];
  }

 private:
  void add(std::size_t number, std::string_view text) {
    constexpr std::string_view separators = " \t\r,";
    Line line;
    line.number = number;
    while (true) {
      const std::size_t start = text.find_first_not_of(separators);
      if (start == std::string_view::npos || (line.values.empty() && text[start] == '#')) break;
      text.remove_prefix(start);
      std::string_view word = text.substr(0, std::min(text.find_first_of(separators), text.size()));
      text.remove_prefix(word.size());
      if (line.values.empty()) line.first = word;
      if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) fail(line, shown(word) + " is not a number");
      line.values.push_back(value);
      if (line.values.size() > 16) fail(line, "has more than 16 values");
    }
    if (!line.values.empty()) lines_.push_back(std::move(line));
  }

  static std::string shown(std::string_view word) { return "`" + std::string(word.substr(0, 24)) + "`"; }

  std::string name_;
  std::vector<Line> lines_;
};

// Marks a pose with values that are not finite while a file is parsed; such poses are left out at the end.
SE3 no_pose() { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d::Constant(std::nan(""))}; }

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

SE3 pose_from_rows(const Lines& lines, const Line& line, const std::vector<double>& v) {
  if (!all_finite(v)) return no_pose();
  const std::optional<SE3> pose = odosplat::pose_from_rows(v);
  if (!pose) lines.fail(line, "the matrix is no rotation");
  return *pose;
}

StampedPose tum_pose(const Lines& lines, const Line& line) {
  const std::vector<double>& v = line.values;
  const double time = lines.stamp(line);
  if (!all_finite(v)) return {time, no_pose(), line.first};
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  try {
    return {time, SE3(rotation_from_text(q), Eigen::Vector3d(v[1], v[2], v[3])), line.first};
  } catch (const InputError& e) {
    lines.fail(line, e.what());
  }
}

// The values of `rows` lines with four values each, starting at line `first`.
std::vector<double> matrix_rows(const Lines& lines, std::size_t first, std::size_t rows) {
  const std::vector<Line>& all = lines.all();
  if (all.size() - first < rows) lines.fail(all.back(), "the last matrix is not complete");
  std::vector<double> values;
  for (std::size_t r = first; r < first + rows; ++r) {
    if (all[r].values.size() != 4) lines.fail(all[r], "expected the 4 values of a matrix row");
    values.insert(values.end(), all[r].values.begin(), all[r].values.end());
  }
  return values;
}

StampedPose numbered_pose(std::size_t number, const SE3& T_world_camera) {
  return {static_cast<double>(number), T_world_camera, std::to_string(number)};
}

Trajectory redwood_log(const Lines& lines) {
  const std::vector<Line>& all = lines.all();
  Trajectory trajectory;
  for (std::size_t i = 0; i < all.size(); i += 5) {
    if (all[i].values.size() != 3) lines.fail(all[i], "expected `i j k` before a matrix");
    const std::vector<double> rows = matrix_rows(lines, i + 1, 4);
    trajectory.push_back({lines.stamp(all[i]), pose_from_rows(lines, all[i + 1], rows), all[i].first});
  }
  return trajectory;
}

Trajectory pose_in_three_rows(const Lines& lines) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < lines.all().size(); i += 3) {
    const SE3 pose = pose_from_rows(lines, lines.all()[i], matrix_rows(lines, i, 3));
    trajectory.push_back(numbered_pose(trajectory.size(), pose));
  }
  return trajectory;
}

Trajectory pose_a_line(const Lines& lines) {
  Trajectory trajectory;
  const std::size_t width = lines.all().front().values.size();
  for (const Line& line : lines.all()) {
    if (line.values.size() != width) {
      lines.fail(line, "has " + std::to_string(line.values.size()) + " values, the lines before have " +
                           std::to_string(width));
    }
    if (width == 8) {
      trajectory.push_back(tum_pose(lines, line));
    } else if (width == 12 || width == 16) {
      trajectory.push_back(numbered_pose(trajectory.size(), pose_from_rows(lines, line, line.values)));
    } else {
      lines.fail(line, "has " + std::to_string(width) + " values; a pose has 8 (TUM), 12 (KITTI) or 16");
    }
  }
  return trajectory;
}

// Throws InputError if times decrease. Each pose takes `lines_a_pose` lines.
void require_order(const Lines& lines, std::size_t lines_a_pose, const Trajectory& trajectory) {
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (!(trajectory[i].time >= trajectory[i - 1].time)) {
      lines.fail(lines.all()[i * lines_a_pose],
                 "time " + trajectory[i].stamp() + " is before " + trajectory[i - 1].stamp());
    }
  }
}

void set_times(const std::string& times_path, Trajectory& trajectory) {
  const Lines lines(times_path, read_file(times_path));
  if (lines.all().size() != trajectory.size()) {
    throw InputError(times_path, "holds " + std::to_string(lines.all().size()) + " times for " +
                                     std::to_string(trajectory.size()) + " poses");
  }
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    trajectory[i].time = lines.stamp(lines.all()[i]);
    trajectory[i].time_text = lines.all()[i].first;
  }
  require_order(lines, 1, trajectory);
}

// All poses that a file lists, with no_pose() in place of those that are not finite.
struct Listed {
  Trajectory poses;
  StampKind stamps = StampKind::times;
};

Listed listed_poses(const std::string& name, const std::string& text) {
  if (is_euroc_csv(text)) {
    log_info(name + ": a table of EuRoC: its poses are of the body (the IMU)");
    return {parse_euroc_csv(name, text), StampKind::times};
  }
  const Lines lines(name, text);
  if (lines.all().empty()) throw InputError(name, "holds no pose");
  const std::size_t first = lines.all().front().values.size();
  const bool log = first == 3;
  const bool rows = first == 4;
  Trajectory trajectory = log ? redwood_log(lines) : rows ? pose_in_three_rows(lines) : pose_a_line(lines);
  require_order(lines, log ? 5 : rows ? 3 : 1, trajectory);
  return {std::move(trajectory), log          ? StampKind::frame_numbers
                                 : first == 8 ? StampKind::times
                                              : StampKind::line_numbers};
}

PoseFile pose_file(const std::string& name, Listed listed) {
  PoseFile file;
  file.stamps = listed.stamps;
  const std::size_t all = listed.poses.size();
  for (std::size_t i = 0; i < all; ++i) {
    StampedPose& pose = listed.poses[i];
    if (!pose.T_world_camera.is_finite()) {
      file.times_without_pose.push_back(pose.time);
      continue;
    }
    file.poses.push_back(std::move(pose));
    file.numbers.push_back(i);
  }
  const std::size_t without = file.times_without_pose.size();
  if (without == all) throw InputError(name, "holds no pose that is finite");
  if (without > 0) {
    log_warning(name + ": " + std::to_string(without) + " of " + std::to_string(all) +
                " poses are not finite and left out");
  }
  return file;
}

}  // namespace

std::optional<SE3> pose_from_rows(const std::vector<double>& rows) {
  const Eigen::Matrix<double, 3, 4> M = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data());
  const Eigen::Matrix3d R = M.leftCols<3>();
  // A tolerance for the 5 to 9 digits of files. Written so that NaN, from huge values, is refused too.
  if (!((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() <= 1e-2) || R.determinant() < 0.0) return std::nullopt;
  // The nearest rotation, because a quaternion computed from the rounded matrix would be 1e-6 degrees off.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return SE3(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()), Eigen::Vector3d(M.col(3)));
}

PoseFile parse_pose_file(const std::string& name, const std::string& text) {
  return pose_file(name, listed_poses(name, text));
}

Trajectory parse_trajectory(const std::string& name, const std::string& text) {
  return parse_pose_file(name, text).poses;
}

std::optional<SE3> parse_pose_matrix(const std::string& name, const std::string& text) {
  const Lines lines(name, text);
  if (lines.all().empty()) return std::nullopt;
  if (lines.all().size() != 4) {
    throw InputError(name, "holds " + std::to_string(lines.all().size()) + " lines of numbers, a 4x4 matrix has 4");
  }
  const SE3 pose = pose_from_rows(lines, lines.all().front(), matrix_rows(lines, 0, 4));
  return pose.is_finite() ? std::optional(pose) : std::nullopt;
}

std::optional<SE3> read_pose_matrix(const std::string& path) { return parse_pose_matrix(path, read_file(path)); }

PoseFile read_pose_file(const std::string& path, const std::string& times_path) {
  Listed listed = listed_poses(path, read_file(path));
  if (!times_path.empty()) {
    set_times(times_path, listed.poses);
    listed.stamps = StampKind::times;
  }
  return pose_file(path, std::move(listed));
}

Trajectory read_trajectory(const std::string& path, const std::string& times_path) {
  return read_pose_file(path, times_path).poses;
}

void write_trajectory(const std::string& path, const Trajectory& trajectory, Durability durability) {
  std::string text = "# time tx ty tz qx qy qz qw  (camera to world, metres)\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d& t = pose.T_world_camera.translation();
    const Eigen::Quaterniond& q = pose.T_world_camera.rotation();
    text += pose.stamp() +
            formatted(" %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  write_file_atomically(path, text, durability);
}

}  // namespace odosplat
