// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/report/report_figure.hpp"
#include "apps/benchmark/report/results.hpp"

namespace odosplat::apps {

/// Writes into `folder`: report.md, report.html (one page, figures within), report.json; tables.csv and tables.tex with
/// all that does not depend on the machine's speed, speed.csv and speed.tex with the rest. Every format prints the
/// same tables. Incomplete results are reported as they are. Each file is written beside its place and renamed.
/// Throws InputError if a file cannot be written or a figure cannot be read.
void write_reports(const BenchmarkResults& results, const std::vector<ReportFigure>& figures,
                   const std::string& folder);

}  // namespace odosplat::apps
