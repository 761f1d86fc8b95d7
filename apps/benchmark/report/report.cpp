// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/report.hpp"

#include "apps/benchmark/report/report_formats.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

std::string mark_word(RankMark mark) {
  switch (mark) {
    case RankMark::best:
      return "best";
    case RankMark::second:
      return "second";
    case RankMark::none:
      break;
  }
  return "";
}

std::string stand_in_warning(const BenchmarkResults& results) {
  if (!results.stand_in) return "";
  return "The sequences are stand-ins: made by this program, with the names and measures of the data sets' own. Their "
         "numbers are not to be ranked against any that were published for the data sets.";
}

void write_reports(const BenchmarkResults& results, const std::vector<ReportFigure>& figures,
                   const std::string& folder) {
  const ReportTables tables = make_report_tables(results);
  write_file_atomically(folder + "/tables.csv", csv_of(tables.accuracy));
  write_file_atomically(folder + "/tables.tex", tex_of(tables.accuracy, results));
  write_file_atomically(folder + "/speed.csv", csv_of(tables.speed));
  write_file_atomically(folder + "/speed.tex", tex_of(tables.speed, results));
  write_file_atomically(folder + "/report.json", json_of(results, tables));
  write_file_atomically(folder + "/report.md", markdown_of(results, tables, figures));
  write_file_atomically(folder + "/report.html", html_of(results, tables, figures, folder));
}

}  // namespace odosplat::apps
