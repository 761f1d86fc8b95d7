// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/run_tables.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string_view>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_rows.hpp"

namespace odosplat::apps {
namespace {

constexpr double same_time = 1e-6;  // [s] of stamps with six decimals

/// The values of a line of a CSV file; a quoted value may contain commas, and "" for a quotation mark.
std::vector<std::string> csv_values(std::string_view line) {
  std::vector<std::string> values(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      values.back() += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      values.emplace_back();
    } else {
      values.back() += c;
    }
  }
  return values;
}

/// The time of a row, not before `previous`.
double time_of(const LineReader& lines, const std::string& word, double previous) {
  const auto time = number_of(word);
  if (!time || !std::isfinite(*time)) lines.fail("the time is no number: " + shown(word));
  if (*time < previous) lines.fail("the time " + shown(word) + " is before that of the previous row");
  return *time;
}

class StatusColumns {
 public:
  StatusColumns(const LineReader& lines, const std::string& heading) : names_(csv_values(heading)) {
    for (const char* needed : {"time", "status", "in_map"}) {
      if (!has(needed)) lines.fail("the heading has no column \"" + std::string(needed) + "\"");
    }
  }
  std::size_t count() const { return names_.size(); }
  /// The column's value; empty if there is no such column.
  std::string value(const std::vector<std::string>& row, std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? "" : row[static_cast<std::size_t>(found - names_.begin())];
  }

 private:
  bool has(std::string_view name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }

  std::vector<std::string> names_;
};

Matrix6d symmetric(const std::vector<double>& upper) {
  Matrix6d matrix;
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = i; j < 6; ++j) matrix(i, j) = matrix(j, i) = upper[k++];
  }
  return matrix;
}

PoseSigma sigma_of(double time, const Matrix6d& covariance, const SE3& T_world_camera) {
  Eigen::Matrix<double, 3, 6> position_by_twist;
  position_by_twist << Eigen::Matrix3d::Identity(), -skew(T_world_camera.translation());
  const double position = (position_by_twist * covariance * position_by_twist.transpose()).trace();
  const double rotation = covariance.bottomRightCorner<3, 3>().trace();
  return {time, std::sqrt(std::max(position, 0.0)), std::sqrt(std::max(rotation, 0.0)) * degrees_per_radian};
}

}  // namespace

std::vector<StatusRow> parse_status_table(const std::string& name, const std::string& text) {
  std::istringstream in(text);
  LineReader lines(name, in);
  std::string line;
  if (!lines.next(line)) throw InputError(name, "is empty");
  const StatusColumns columns(lines, line);
  std::vector<StatusRow> rows;
  while (lines.next(line)) {
    if (line.empty()) continue;
    const std::vector<std::string> values = csv_values(line);
    if (values.size() != columns.count()) {
      lines.fail("has " + std::to_string(values.size()) + " values, the heading " + std::to_string(columns.count()));
    }
    StatusRow row;
    row.time = time_of(lines, columns.value(values, "time"), rows.empty() ? -HUGE_VAL : rows.back().time);
    row.status = columns.value(values, "status");
    if (row.status != "ok" && row.status != "relocalised" && row.status != "lost") {
      lines.fail("status must be ok, relocalised or lost, is " + shown(row.status));
    }
    row.keyframe = columns.value(values, "keyframe") == "1";
    row.in_map = columns.value(values, "in_map") == "1";
    if (const auto confirmed = number_of(columns.value(values, "confirmed"))) row.confirmed = *confirmed;
    row.reason = columns.value(values, "reason");
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<PoseSigma> parse_covariance_table(const std::string& name, const std::string& text,
                                              const Trajectory& poses) {
  std::istringstream in(text);
  LineReader lines(name, in);
  std::vector<PoseSigma> sigmas;
  double previous = -HUGE_VAL;
  std::size_t pose = 0;
  for (std::string line; lines.next(line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("time")) continue;
    const std::vector<std::string> values = csv_values(line);
    if (values.size() != 22) lines.fail("has " + std::to_string(values.size()) + " values, must have 22");
    previous = time_of(lines, values[0], previous);
    std::vector<double> upper;
    for (std::size_t k = 1; k < values.size(); ++k) {
      const auto value = number_of(values[k]);
      if (!value || !std::isfinite(*value)) lines.fail("is no number: " + shown(values[k]));
      upper.push_back(*value);
    }
    while (pose < poses.size() && poses[pose].time < previous - same_time) ++pose;
    if (pose == poses.size() || poses[pose].time > previous + same_time) continue;
    sigmas.push_back(sigma_of(previous, symmetric(upper), poses[pose].T_world_camera));
  }
  return sigmas;
}

}  // namespace odosplat::apps
