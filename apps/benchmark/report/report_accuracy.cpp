// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The tables of errors: measured ones and the paper's.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/benchmark/report/report_table.hpp"

namespace odosplat::apps {
namespace {

constexpr int decimals = 4;
// A run with a lower coverage is evaluated on other frames than the others, so it is not ranked.
constexpr double least_ranked_coverage = 0.9;
constexpr double whole_coverage = 0.99;

struct Metric {
  const char* group;
  const char* quantity;
  CellSummary::Value CellSummary::*value;
};
const std::array<Metric, 3> metrics{{{"RMSE of ATE (m)", "ate_m", &CellSummary::ate_m},
                                     {"RMSE of RTE (m)", "rte_m", &CellSummary::rte_m},
                                     {"RMSE of RRE (deg)", "rre_deg", &CellSummary::rre_deg}}};

bool ranked(const CellSummary& summary) { return summary.complete() && summary.coverage.low >= least_ranked_coverage; }

/// Rounded down, so that 100 % means every frame.
double percent_of(double share) { return std::floor(1000.0 * share + 1e-9) / 10.0; }

std::string doubt_about(const CellSummary& summary) {
  std::string doubt;
  if (summary.failed > 0) {
    doubt = std::to_string(summary.runs) + " of " + std::to_string(summary.runs + summary.failed) +
            " runs went through, not ranked; another: " + summary.fault;
  }
  if (summary.coverage.low < whole_coverage) {
    doubt += (doubt.empty() ? "" : "; ") + std::string("posed ") + fixed_text(percent_of(summary.coverage.low), 1) +
             " % of the frames";
    if (summary.failed == 0 && !ranked(summary)) doubt += ", not ranked";
  }
  return doubt;
}

/// A row for each sequence, a column for each metric and method.
void fill_metrics(ReportTable& table, const BenchmarkResults& results, const std::vector<std::string>& methods,
                  bool mark_second) {
  table.row_head = "Sequence";
  table.label = label_of(results);
  for (const Metric& metric : metrics) {
    for (const std::string& method : methods) table.columns.push_back({metric.group, method, method, metric.quantity});
  }
  for (const SequenceFacts& sequence : results.sequences) {
    ReportRow row;
    row.name = sequence.name;
    for (const Metric& metric : metrics) {
      std::vector<std::optional<double>> values;
      for (const std::string& method : methods) {
        const auto summary = summarise(results, sequence.name, method);
        if (!summary) {
          row.cells.push_back(words_cell("-"));
        } else if (summary->runs == 0) {
          row.cells.push_back(failed_cell(table, summary->fault));
        } else {
          row.cells.push_back(value_cell((*summary).*metric.value, summary->runs, decimals));
          const std::string doubt = doubt_about(*summary);
          if (!doubt.empty()) row.cells.back().note = table.note_number(doubt);
        }
        values.push_back(summary && ranked(*summary) ? row.cells.back().value : std::nullopt);
      }
      if (methods.size() < 2) continue;
      const std::vector<int> place = places(values, decimals);
      const std::size_t first = row.cells.size() - methods.size();
      for (std::size_t m = 0; m < methods.size(); ++m) {
        if (place[m] == 1) row.cells[first + m].mark = RankMark::best;
        if (place[m] == 2 && mark_second) row.cells[first + m].mark = RankMark::second;
      }
    }
    table.rows.push_back(std::move(row));
  }
}

std::string runs_words(const BenchmarkResults& results) {
  if (results.runs < 2) return "";
  return " Median over " + std::to_string(results.runs) + " runs, with the lowest and the highest.";
}

}  // namespace

ReportTable accuracy_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "accuracy";
  table.title = "Accuracy of localisation (the paper's Table 2)";
  table.caption =
      "Final trajectory against the truth in the map's frame, without alignment; RTE and RRE from frame to frame." +
      runs_words(results) + " Best bold, second underlined, as printed; x: no result.";
  fill_metrics(table, results, results.methods, true);
  return table;
}

std::optional<ReportTable> ablation_table(const BenchmarkResults& results) {
  std::vector<std::string> methods;
  for (const char* method : {"interpolation", "gaussian_no_anchor", "gaussian"}) {
    if (std::ranges::find(results.methods, method) != results.methods.end()) methods.emplace_back(method);
  }
  if (methods.size() < 2 || methods.back() != "gaussian") return std::nullopt;
  ReportTable table;
  table.key = "ablation";
  table.title = "Ablation: where depth comes from (the paper's Table 3)";
  table.caption = "Depth interpolated in the point cloud against depth rendered from Gaussians." + runs_words(results) +
                  " Best bold; x: no result.";
  fill_metrics(table, results, methods, false);
  return table;
}

ReportTable summary_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "summary";
  table.title = "Methods over all sequences";
  table.caption = "ATE as above. Best: on how many sequences its ATE is the smallest, ties included.";
  table.label = label_of(results);
  table.row_head = "Method";
  table.columns = {{"", "complete", "", "sequences_complete"},
                   {"", "of", "", "sequences"},
                   {"", "best", "", "sequences_best"},
                   {"", "median ATE (m)", "", "ate_median_m"},
                   {"", "largest ATE (m)", "", "ate_largest_m"}};
  std::vector<int> complete(results.methods.size(), 0);
  std::vector<int> best(results.methods.size(), 0);
  std::vector<std::vector<double>> errors(results.methods.size());
  for (const SequenceFacts& sequence : results.sequences) {
    std::vector<std::optional<double>> values;
    for (std::size_t m = 0; m < results.methods.size(); ++m) {
      const auto summary = summarise(results, sequence.name, results.methods[m]);
      const bool counts = summary && ranked(*summary);
      values.push_back(counts ? std::optional(summary->ate_m.median) : std::nullopt);
      if (!counts) continue;
      ++complete[m];
      errors[m].push_back(summary->ate_m.median);
    }
    const std::vector<int> place = places(values, decimals);
    for (std::size_t m = 0; m < place.size(); ++m) best[m] += place[m] == 1 ? 1 : 0;
  }
  for (std::size_t m = 0; m < results.methods.size(); ++m) {
    ReportRow row;
    row.name = results.methods[m];
    row.cells.push_back(number_cell(complete[m], 0));
    row.cells.push_back(number_cell(static_cast<double>(results.sequences.size()), 0));
    row.cells.push_back(number_cell(best[m], 0));
    std::ranges::sort(errors[m]);
    const bool any = !errors[m].empty();
    row.cells.push_back(any ? number_cell(percentile(errors[m], 50.0), decimals) : words_cell("-"));
    row.cells.push_back(any ? number_cell(errors[m].back(), decimals) : words_cell("-"));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable details_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "details";
  table.title = "Coverage and further errors";
  table.caption =
      "Aligned: after the best rigid motion onto the truth. Live: poses as known when their frames came. Largest: of "
      "the unaligned positions." +
      runs_words(results);
  table.label = label_of(results);
  table.row_head = "Sequence";
  table.method_head = "Method";
  table.columns = {{"", "posed (%)", "", "coverage_percent"},
                   {"", "lost", "", "frames_lost"},
                   {"", "ATE (m)", "", "ate_m"},
                   {"", "aligned (m)", "", "ate_aligned_m"},
                   {"", "live (m)", "", "ate_live_m"},
                   {"", "largest (m)", "", "ate_max_m"}};
  for (const SequenceFacts& sequence : results.sequences) {
    for (const std::string& method : results.methods) {
      const auto summary = summarise(results, sequence.name, method);
      if (!summary) continue;
      ReportRow row{sequence.name, method, {}};
      if (summary->runs == 0) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
          row.cells.push_back(failed_cell(table, summary->fault));
        }
      } else {
        const CellSummary::Value posed{percent_of(summary->coverage.median), percent_of(summary->coverage.low),
                                       percent_of(summary->coverage.high)};
        row.cells.push_back(value_cell(posed, summary->runs, 1));
        row.cells.push_back(value_cell(summary->lost, summary->runs, 0));
        row.cells.push_back(value_cell(summary->ate_m, summary->runs, decimals));
        row.cells.push_back(value_cell(summary->ate_aligned_m, summary->runs, decimals));
        row.cells.push_back(value_cell(summary->live_ate_m, summary->runs, decimals));
        row.cells.push_back(value_cell(summary->ate_max_m, summary->runs, decimals));
        if (summary->failed > 0) row.cells.front().note = table.note_number(doubt_about(*summary));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

ReportTable paper_table(const BenchmarkResults& results) {
  constexpr int published_decimals = 3;
  ReportTable table;
  table.key = "paper";
  table.title = "The paper's figures";
  table.label = "as published";
  table.caption =
      "Tables 2 and 3 (interpolation) of the GS-DSO paper, as its authors published them, measured by nobody here; "
      "its MonoGS was aligned to the truth with scale, the others were not.";
  if (results.stand_in) {
    table.caption +=
        " They are of other sequences of the same names, the data sets' own, and are not to be ranked against the "
        "stand-ins above.";
  }
  table.row_head = "Sequence";
  for (const Metric& metric : metrics) {
    for (const PaperRow& row : paper_rows()) {
      if (std::string(row.sequence) == "icl_1") {
        table.columns.push_back({metric.group, row.method, row.method, metric.quantity});
      }
    }
  }
  const std::size_t methods = table.columns.size() / metrics.size();
  for (std::size_t first = 0; first < paper_rows().size(); first += methods) {
    ReportRow row;
    row.name = paper_rows()[first].sequence;
    for (const auto value : {&PaperRow::ate_m, &PaperRow::rte_m, &PaperRow::rre_deg}) {
      for (std::size_t m = 0; m < methods; ++m) {
        const double published = paper_rows()[first + m].*value;
        row.cells.push_back(published < 0.0 ? failed_cell(table, "crashed, says the paper")
                                            : number_cell(published, published_decimals));
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace odosplat::apps
