// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/benchmark/report/report.hpp"
#include "apps/input/map_views.hpp"

namespace odosplat::apps {

/// Draws the paper's Figures 1, 4 and 5 and the errors over time into `folder`/figures, for write_reports(). `maps`:
/// map of Gaussians and cloud of each sequence by its name, as the runs of method gaussian used them. A figure that
/// cannot be drawn (no map, no run) is returned with the reason; the others are still drawn. Throws Interrupted after
/// Ctrl-C, InputError if the folder cannot be written.
std::vector<ReportFigure> draw_benchmark_figures(const Common& common, const BenchmarkResults& results,
                                                 const std::map<std::string, MapFlags>& maps,
                                                 const std::string& folder);

/// The figures that need no map, as images.
/// Draws the trajectories of up to four sequences, the paper's if they are present; InputError if none has a run and a
/// truth.
cv::Mat3b benchmark_trajectories(const BenchmarkResults& results, std::vector<std::string>& drawn);
/// Draws a panel for each sequence with a run and a truth. InputError if there is none.
cv::Mat3b benchmark_errors(const BenchmarkResults& results);

}  // namespace odosplat::apps
