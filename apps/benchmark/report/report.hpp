// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/report/report_figure.hpp"
#include "apps/benchmark/report/results.hpp"

namespace odosplat::apps {

/// Writes the report into `folder`:
///   report.md, report.html (one page with the figures embedded), report.json: everything
///   tables.csv, tables.tex: all that does not depend on the machine's speed
///   speed.csv, speed.tex: the rest
/// All formats print the same tables. Incomplete results are reported as they are. Each file is written to a temporary
/// file and renamed. Throws InputError if a file cannot be written or a figure cannot be read.
void write_reports(const BenchmarkResults& results, const std::vector<ReportFigure>& figures,
                   const std::string& folder);

}  // namespace odosplat::apps
