// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "odosplat/io/atomic_file.hpp"

namespace odosplat::accuracy {

Row& Row::text(const std::string& column, const std::string& value) {
  cells_.push_back({column, value, value});
  return *this;
}

Row& Row::count(const std::string& column, long value) {
  cells_.push_back({column, std::to_string(value), value});
  return *this;
}

Row& Row::number(const std::string& column, double value, int decimals) {
  char shown[64];
  std::snprintf(shown, sizeof(shown), "%.*f", decimals, value);
  const bool finite = std::isfinite(value);
  cells_.push_back({column, finite ? shown : "-", finite ? nlohmann::ordered_json(value) : nullptr});
  return *this;
}

Row& Row::flag(const std::string& column, bool value) {
  cells_.push_back({column, value ? "yes" : "no", value});
  return *this;
}

Output::Output(const Job& job) : json_file_(job.json), trace_file_(job.trace) {
  if (!json_file_.empty()) ensure_output_file(json_file_).keep();
  if (!trace_file_.empty()) ensure_output_file(trace_file_).keep();
}

void Output::add(const Row& row) {
  constexpr int narrowest = 8;
  std::vector<std::string> columns;
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  std::string head;
  std::string line;
  for (const Row::Cell& cell : row.cells_) {
    columns.push_back(cell.column);
    values[cell.column] = cell.value;
    // Text columns are aligned to the left, numbers to the right.
    const bool left = cell.value.is_string();
    const int width = std::max(left ? 20 : narrowest, static_cast<int>(cell.column.size()));
    char text[128];
    std::snprintf(text, sizeof(text), left ? "%-*s  " : "%*s  ", width, cell.column.c_str());
    head += text;
    std::snprintf(text, sizeof(text), left ? "%-*s  " : "%*s  ", width, cell.shown.c_str());
    line += text;
  }
  if (columns != columns_) std::printf("%s%s\n", columns_.empty() ? "" : "\n", head.c_str());
  columns_ = columns;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  rows_.push_back(values);
}

void Output::trace(const World& world, const std::string& run_name, const Run& run) {
  if (trace_file_.empty()) return;
  for (const PlayedFrame& frame : run.frames) {
    const TrackResult& r = frame.result;
    const bool posed = r.status != TrackStatus::lost;
    const PoseError error = posed ? pose_error(frame) : PoseError{-1.0, -1.0};
    const double nees =
        posed ? normalised_error_squared(r.T_world_camera, frame.T_world_camera_true, r.covariance) : -1;
    char line[256];
    std::snprintf(line, sizeof(line),
                  "%s,%.6f,%zu,%d,%s,%d,%d,%.3f,%.4f,%.4f,%.4f,%.3f,%.4f,%.3f,%.2f,%.4f,%d,%.4f,%.3f,%.1f\n",
                  run_name.c_str(), frame.time, world.number(frame.frame), frame.blind ? 1 : 0,
                  to_string(r.status).c_str(), r.keyframe ? 1 : 0, r.anchored ? 1 : 0, 1000.0 * error.meters,
                  error.degrees, r.inlier_share, r.coverage, 255.0 * r.rmse, r.map_share, nees, r.milliseconds,
                  r.evidence.score, r.evidence.patches, r.evidence.probability, r.evidence.against, 1000.0 * r.misfit);
    trace_ += line;
  }
}

void Output::write() const {
  if (!json_file_.empty()) write_file_atomically(json_file_, rows_.dump(2) + "\n");
  if (trace_file_.empty()) return;
  write_file_atomically(trace_file_,
                        "run,time,frame,blind,status,keyframe,anchored,error_mm,error_deg,inlier_share,coverage,"
                        "rmse_grey,map_share,nees,milliseconds,score,patches,confirmed,against,misfit_mm\n" +
                            trace_);
}

Row row_of(const World& world, const std::string& scenario, const Judged& judged) {
  Row row;
  row.text("set", world.name())
      .text("scenario", scenario)
      .count("frames", static_cast<long>(judged.frames))
      .count("lost", static_cast<long>(judged.lost))
      .number("ate_mm", 1000.0 * judged.ate_m.rmse, 2)
      .number("max_mm", 1000.0 * judged.ate_m.max, 2);
  return row;
}

}  // namespace odosplat::accuracy
