// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/report_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "odosplat/core/formatted.hpp"

namespace odosplat::apps {

bool ReportTable::has_groups() const {
  return std::ranges::any_of(columns, [](const ReportColumn& c) { return !c.group.empty(); });
}

int ReportTable::note_number(const std::string& words) {
  const auto known = std::ranges::find(notes, words);
  if (known != notes.end()) return static_cast<int>(known - notes.begin()) + 1;
  notes.push_back(words);
  return static_cast<int>(notes.size());
}

ReportTables make_report_tables(const BenchmarkResults& results) {
  ReportTables tables;
  tables.accuracy.push_back(sequences_table(results));
  tables.accuracy.push_back(accuracy_table(results));
  tables.accuracy.push_back(summary_table(results));
  if (auto ablation = ablation_table(results)) tables.accuracy.push_back(std::move(*ablation));
  tables.accuracy.push_back(details_table(results));
  if (!results.maps.empty()) tables.accuracy.push_back(maps_table(results));
  tables.accuracy.push_back(paper_table(results));
  tables.speed.push_back(speed_table(results));
  if (!results.maps.empty()) tables.speed.push_back(training_table(results));
  return tables;
}

std::string label_of(const BenchmarkResults& results) { return results.stand_in ? "stand-in" : ""; }

std::string fixed_text(double value, int decimals) {
  return std::isfinite(value) ? formatted("%.*f", decimals, value) : "-";
}

std::string exact_text(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 64> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

ReportCell words_cell(const std::string& text) {
  ReportCell cell;
  cell.text = text;
  return cell;
}

ReportCell number_cell(double value, int decimals) {
  ReportCell cell;
  cell.text = fixed_text(value, decimals);
  cell.value = value;
  return cell;
}

ReportCell value_cell(const CellSummary::Value& value, int runs, int decimals) {
  ReportCell cell = number_cell(value.median, decimals);
  if (runs > 1) {
    cell.low = value.low;
    cell.high = value.high;
    cell.spread = fixed_text(value.low, decimals) + ".." + fixed_text(value.high, decimals);
  }
  return cell;
}

ReportCell failed_cell(ReportTable& table, const std::string& fault) {
  ReportCell cell = words_cell("x");
  cell.failed = true;
  cell.note = table.note_number(fault);
  return cell;
}

std::vector<ReportFact> report_facts(const BenchmarkResults& results) {
  std::vector<ReportFact> facts;
  const auto add = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) facts.push_back({name, text});
  };
  add("suite", results.suite);
  add("data", results.stand_in ? "stand-in sequences made by this program, not the data sets of those names" : "");
  add("mapping", results.mapping);
  add("cut short", results.quick);
  add("runs of each cell", std::to_string(results.runs));
  std::set<std::uint64_t> seeds;
  for (const RunFacts& run : results.cells) seeds.insert(run.seed);
  std::string words;
  for (const std::uint64_t seed : seeds) words += (words.empty() ? "" : ", ") + std::to_string(seed);
  add("seeds", words);
  add("machine", results.machine);
  add("device", results.device);
  add("version", results.version);
  add("command", results.command);
  return facts;
}

}  // namespace odosplat::apps
