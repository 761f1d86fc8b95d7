// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/page_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"

namespace odosplat::apps {
namespace {

namespace fs = std::filesystem;

constexpr double same_frame = 0.0005;    // [s]
constexpr double truth_distance = 0.01;  // [s] of a true pose from a frame, as eval's
constexpr float none = std::numeric_limits<float>::quiet_NaN();

std::string trajectory_file(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error) ? (fs::path(path) / "trajectory.txt").string() : path;
}

std::string short_name(const std::string& path) {
  const fs::path file = fs::path(trajectory_file(path)).lexically_normal();
  const std::string folder = fs::absolute(file).parent_path().filename().string();
  return file.filename() == "trajectory.txt" && !folder.empty() ? folder : file.filename().string();
}

/// The text of a table beside the trajectory; empty if there is none.
std::string table_beside(const std::string& file) {
  std::error_code error;
  return fs::exists(file, error) ? read_file(file) : "";
}

void read_tables(const std::string& trajectory, PageRun& run) {
  const std::string status = (fs::path(trajectory).parent_path() / "status.csv").string();
  const std::string covariance = (fs::path(trajectory).parent_path() / "covariance.csv").string();
  if (const std::string text = table_beside(status); text.starts_with("time,status,")) {
    run.status = parse_status_table(status, text);
  }
  if (const std::string text = table_beside(covariance); !text.empty()) {
    run.sigmas = parse_covariance_table(covariance, text, run.estimate);
  }
}

PageRun read_run(const std::string& path, const std::string& times, const TruthFlags& truth,
                 TrajectoryAlignment alignment) {
  PageRun run;
  run.name = short_name(path);
  const std::string file = trajectory_file(path);
  JudgedTrajectory judged = read_judged(file, times, truth);
  run.estimate = std::move(judged.estimate);
  require_near_origin(file, run.estimate);
  read_tables(file, run);
  if (judged.truth.empty()) return run;
  EvalOptions options;
  options.alignment = alignment;
  run.result = evaluate(run.estimate, judged.truth, options);
  for (const Match& match : run.result->matches) {
    const SE3 estimated = run.result->truth_from_estimate * run.estimate[match.estimate].T_world_camera;
    const SE3 error = judged.truth[match.truth].T_world_camera.inverse() * estimated;
    run.rotation_errors_deg.push_back(error.angle() * degrees_per_radian);
  }
  if (!run.result->doubt.empty()) log_warning(file + ": only " + run.result->doubt);
  const TimeSpan span = judged.span.value_or(TimeSpan{run.estimate.front().time, run.estimate.back().time});
  for (const StampedPose& pose : judged.truth) {
    if (pose.time >= span.first - truth_distance && pose.time <= span.last + truth_distance) run.truth.push_back(pose);
  }
  return run;
}

void put_pose(std::vector<float>& poses, std::size_t frame, const SE3& T_world_camera) {
  const Eigen::Vector3f t = T_world_camera.translation().cast<float>();
  const Eigen::Quaternionf q = T_world_camera.rotation().cast<float>();
  const std::array<float, 7> row{t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
  std::copy(row.begin(), row.end(), poses.begin() + static_cast<std::ptrdiff_t>(7 * frame));
}

nlohmann::ordered_json json_of(const Statistics& s) { return {{"rmse", s.rmse}, {"median", s.median}, {"max", s.max}}; }

/// Frames before whose pose others are missing: lost ones, or without a table of frames a step in time that is much
/// longer than the others.
std::vector<float> gaps_of(const PageRun& run, const std::vector<double>& times, const std::vector<float>& status) {
  std::vector<float> gaps(times.size(), 0.0F);
  const double longest = run.status.empty() ? longest_step(run.estimate) : std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < run.estimate.size(); ++k) {
    const auto before = page_frame(times, run.estimate[k - 1].time);
    const auto at = page_frame(times, run.estimate[k].time);
    if (!before || !at) continue;
    bool missing = run.estimate[k].time - run.estimate[k - 1].time > longest;
    for (std::size_t f = *before + 1; f < *at; ++f) missing = missing || status[f] == 3.0F;
    gaps[*at] = missing ? 1.0F : 0.0F;
  }
  return gaps;
}

float status_code(const std::string& status) { return status == "ok" ? 1.0F : status == "relocalised" ? 2.0F : 3.0F; }

void add_status(const PageRun& run, const std::vector<double>& times, PageNumbers& numbers,
                nlohmann::ordered_json& json) {
  std::vector<float> status(times.size(), 0.0F);
  std::vector<float> in_map(times.size(), none);
  std::vector<float> keyframe(times.size(), none);
  std::vector<float> confirmed(times.size(), none);
  nlohmann::ordered_json reasons = nlohmann::ordered_json::object();
  for (const StatusRow& row : run.status) {
    const auto f = page_frame(times, row.time);
    if (!f) continue;
    status[*f] = status_code(row.status);
    in_map[*f] = row.in_map ? 1.0F : 0.0F;
    keyframe[*f] = row.keyframe ? 1.0F : 0.0F;
    confirmed[*f] = static_cast<float>(row.confirmed);
    if (!row.reason.empty()) reasons[std::to_string(*f)] = row.reason;
  }
  json["gap"] = numbers.add(gaps_of(run, times, status));
  if (run.status.empty()) return;
  json["status"] = numbers.add(status);
  json["in_map"] = numbers.add(in_map);
  json["keyframe"] = numbers.add(keyframe);
  json["confirmed"] = numbers.add(confirmed);
  json["reasons"] = reasons;
}

void add_sigmas(const PageRun& run, const std::vector<double>& times, PageNumbers& numbers,
                nlohmann::ordered_json& json) {
  if (run.sigmas.empty()) return;
  std::vector<float> position(times.size(), none);
  std::vector<float> rotation(times.size(), none);
  for (const PoseSigma& sigma : run.sigmas) {
    const auto f = page_frame(times, sigma.time);
    if (!f) continue;
    position[*f] = static_cast<float>(sigma.position_m);
    rotation[*f] = static_cast<float>(sigma.rotation_deg);
  }
  json["sigma_m"] = numbers.add(position);
  json["sigma_deg"] = numbers.add(rotation);
}

void add_errors(const PageRun& run, const std::vector<double>& times, PageNumbers& numbers,
                nlohmann::ordered_json& json) {
  if (!run.result) return;
  const EvalResult& result = *run.result;
  const Similarity& truth_from_estimate = result.truth_from_estimate;
  std::vector<float> position(times.size(), none);
  std::vector<float> rotation(times.size(), none);
  for (std::size_t k = 0; k < result.matches.size(); ++k) {
    const auto f = page_frame(times, run.estimate[result.matches[k].estimate].time);
    if (!f) continue;
    position[*f] = static_cast<float>(result.position_errors_m[k]);
    rotation[*f] = static_cast<float>(run.rotation_errors_deg[k]);
  }
  json["position_error_m"] = numbers.add(position);
  json["rotation_error_deg"] = numbers.add(rotation);
  json["ate_m"] = json_of(result.ate_m);
  json["are_deg"] = json_of(result.are_deg);
  json["pairs"] = result.pairs;
  if (result.alignment == TrajectoryAlignment::none) return;
  std::vector<float> pose(7);
  put_pose(pose, 0, truth_from_estimate.T_target_source);
  json["align"] = {{"scale", truth_from_estimate.scale}, {"pose", pose}};
}

}  // namespace

std::vector<PageRun> read_page_runs(const std::vector<std::string>& paths, const std::string& times,
                                    const TruthFlags& truth, TrajectoryAlignment alignment) {
  std::vector<PageRun> runs;
  std::multiset<std::string> names;
  for (const std::string& path : paths) {
    runs.push_back(read_run(path, times, truth, alignment));
    names.insert(runs.back().name);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (names.count(runs[i].name) > 1) runs[i].name = paths[i];
  }
  return runs;
}

std::vector<double> page_times(const std::vector<PageRun>& runs, const Trajectory& truth,
                               const std::vector<double>& image_times) {
  std::vector<double> all;
  for (const PageRun& run : runs) {
    for (const StampedPose& pose : run.estimate) all.push_back(pose.time);
    for (const StatusRow& row : run.status) all.push_back(row.time);
  }
  if (runs.empty()) {
    for (const StampedPose& pose : truth) all.push_back(pose.time);
  }
  if (all.empty()) all = image_times;
  std::sort(all.begin(), all.end());
  std::vector<double> times;
  for (const double time : all) {
    if (times.empty() || time - times.back() > same_frame) times.push_back(time);
  }
  return times;
}

std::optional<std::size_t> page_frame(const std::vector<double>& times, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time - same_frame);
  if (after == times.end() || *after > time + same_frame) return std::nullopt;
  return static_cast<std::size_t>(after - times.begin());
}

nlohmann::ordered_json json_of_run(const PageRun& run, const std::vector<double>& times, PageNumbers& numbers) {
  std::vector<float> poses(7 * times.size(), none);
  for (const StampedPose& pose : run.estimate) {
    if (const auto f = page_frame(times, pose.time)) put_pose(poses, *f, pose.T_world_camera);
  }
  nlohmann::ordered_json json{{"name", run.name}, {"posed", run.estimate.size()}, {"poses", numbers.add(poses)}};
  add_status(run, times, numbers, json);
  add_sigmas(run, times, numbers, json);
  add_errors(run, times, numbers, json);
  return json;
}

nlohmann::ordered_json json_of_truth(const Trajectory& truth, const std::vector<double>& times, PageNumbers& numbers) {
  std::vector<float> poses(7 * times.size(), none);
  std::vector<float> path;
  std::size_t k = 0;
  for (std::size_t f = 0; f < times.size() && !truth.empty(); ++f) {
    const auto distance = [&](std::size_t i) { return std::abs(truth[i].time - times[f]); };
    while (k + 1 < truth.size() && distance(k + 1) <= distance(k)) ++k;
    if (distance(k) <= truth_distance) put_pose(poses, f, truth[k].T_world_camera);
  }
  for (const StampedPose& pose : truth) {
    const Eigen::Vector3f t = pose.T_world_camera.translation().cast<float>();
    path.insert(path.end(), {t.x(), t.y(), t.z()});
  }
  return {{"poses", numbers.add(poses)}, {"path", numbers.add(path)}};
}

}  // namespace odosplat::apps
