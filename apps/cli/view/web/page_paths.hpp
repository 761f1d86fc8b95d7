// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/view/web/page_numbers.hpp"
#include "apps/cli/view/web/run_tables.hpp"
#include "apps/input/truth.hpp"
#include "odosplat/eval/evaluate.hpp"

/// Paths of a page: estimated ones with what is known of their frames, and the true one.
namespace odosplat::apps {

/// An estimated trajectory with the tables beside it.
struct PageRun {
  std::string name;
  Trajectory estimate;
  Trajectory truth;                         // within the run's time; empty: unknown
  std::optional<EvalResult> result;         // with a truth
  std::vector<double> rotation_errors_deg;  // one per match of the result, as in its are_deg
  std::vector<StatusRow> status;            // empty: there is no status.csv
  std::vector<PoseSigma> sigmas;            // empty: there is no covariance.csv
};

/// Reads the runs: each a file of poses or a folder that `track` wrote (its trajectory.txt). status.csv and
/// covariance.csv beside a trajectory are read if they are there and, for status.csv, if its first line is that of
/// `track`. `times`: file of times for formats without. Errors after `alignment`, as `eval` computes them; a warning
/// where less than half of an estimate matches. Runs are called by their folder or file, by the whole path where two
/// have one name. InputError as read_judged, evaluate and the tables' readers.
std::vector<PageRun> read_page_runs(const std::vector<std::string>& paths, const std::string& times,
                                    const TruthFlags& truth, TrajectoryAlignment alignment);

/// The times of the page's frames [s], ascending: those of all rows and poses of the runs, times within half a
/// millisecond counting as one; without runs those of the true poses; without these `image_times`.
std::vector<double> page_times(const std::vector<PageRun>& runs, const Trajectory& truth,
                               const std::vector<double>& image_times);

/// The frame of a time, at most half a millisecond away; none if there is no such frame.
std::optional<std::size_t> page_frame(const std::vector<double>& times, double time);

/// For F frames: poses [F x 7] tx ty tz qx qy qz qw; position_error_m, rotation_error_deg, sigma_m, sigma_deg,
/// confirmed [F]; status [F]: 0 unknown, 1 ok, 2 relocalised, 3 lost; in_map, keyframe [F]: 0 or 1; gap [F]: 1 if poses
/// are missing between this one and the one before; reasons of lost frames by frame; statistics; align, the similarity
/// that brings the estimate to the truth, if it is not the identity.
nlohmann::ordered_json json_of_run(const PageRun& run, const std::vector<double>& times, PageNumbers& numbers);

/// For F frames: poses [F x 7], those within 10 ms; path [M x 3], all positions.
nlohmann::ordered_json json_of_truth(const Trajectory& truth, const std::vector<double>& times, PageNumbers& numbers);

}  // namespace odosplat::apps
