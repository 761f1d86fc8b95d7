// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/report/report_figure.hpp"
#include "apps/benchmark/report/report_table.hpp"

/// The text of a report in each of its formats.
namespace odosplat::apps {

/// One row for each cell of each table: table, row, method, quantity (with its unit), value at full precision or text,
/// low and high over several runs, the text that the other formats print, mark (best, second), note, label.
std::string csv_of(const std::vector<ReportTable>& tables);

/// A table* for each table, for a document with the packages booktabs and ulem. ASCII except for names and texts in the
/// results.
std::string tex_of(const std::vector<ReportTable>& tables, const BenchmarkResults& results);

std::string markdown_of(const BenchmarkResults& results, const ReportTables& tables,
                        const std::vector<ReportFigure>& figures);

/// One page without references to other files. `folder`: where the figures' files are. InputError for a figure that
/// cannot be read.
std::string html_of(const BenchmarkResults& results, const ReportTables& tables,
                    const std::vector<ReportFigure>& figures, const std::string& folder);

std::string json_of(const BenchmarkResults& results, const ReportTables& tables);

/// "best", "second" or "".
std::string mark_word(RankMark mark);
/// The sentence at the top of a report on stand-ins; empty for others.
std::string stand_in_warning(const BenchmarkResults& results);

}  // namespace odosplat::apps
