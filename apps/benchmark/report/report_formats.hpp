// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/report/report_figure.hpp"
#include "apps/benchmark/report/report_table.hpp"

/// A report's text in each of its formats, a file each.
namespace odosplat::apps {

/// A row for each cell of each table: table, row, method, quantity (with its unit), value at full precision or words,
/// low and high over several runs, the text that the other formats print, mark (best, second), note, label.
std::string csv_of(const std::vector<ReportTable>& tables);

/// A table* for each table, for a document with the packages booktabs and ulem; ASCII but for the results' own words.
std::string tex_of(const std::vector<ReportTable>& tables, const BenchmarkResults& results);

std::string markdown_of(const BenchmarkResults& results, const ReportTables& tables,
                        const std::vector<ReportFigure>& figures);

/// One page that refers to nothing outside itself. `folder`: where the figures' files are. InputError for one that
/// cannot be read.
std::string html_of(const BenchmarkResults& results, const ReportTables& tables,
                    const std::vector<ReportFigure>& figures, const std::string& folder);

std::string json_of(const BenchmarkResults& results, const ReportTables& tables);

/// "best", "second" or "".
std::string mark_word(RankMark mark);
/// The sentence at the head of a report of stand-ins; empty for others.
std::string stand_in_warning(const BenchmarkResults& results);

}  // namespace odosplat::apps
