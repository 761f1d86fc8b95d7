// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/benchmark/report/results.hpp"

/// The tables of a benchmark's reports as data: every format (Markdown, HTML, CSV, LaTeX, JSON) prints these, so that
/// all have the same content.
namespace odosplat::apps {

enum class RankMark { none, best, second };

struct ReportCell {
  std::string text;             // as printed; empty: blank cell
  std::optional<double> value;  // printed value at full precision in the column's unit; none for text
  std::optional<double> low;    // lowest of several runs
  std::optional<double> high;
  std::string spread;   // low and high as printed; empty: one run
  bool failed = false;  // no result: the text is "x"
  RankMark mark = RankMark::none;
  int note = 0;  // number of its footnote, from 1; 0: none
};

struct ReportColumn {
  std::string group;     // printed over neighbouring columns of the same group; empty: none
  std::string head;      // column header as printed
  std::string method;    // method that the values belong to; empty: the row's
  std::string quantity;  // name with unit, for programs: "ate_m"
  bool words = false;    // holds text, not numbers
};

struct ReportRow {
  std::string name;    // of a sequence, map or method
  std::string method;  // second part of the row's name; empty: none
  std::vector<ReportCell> cells;
};

struct ReportTable {
  std::string key;  // "accuracy"
  std::string title;
  std::string caption;      // sentences below the title
  std::string label;        // "stand-in" or "as published"; empty: results of this program on the sequences named
  std::string row_head;     // header over the rows' names
  std::string method_head;  // header over the rows' methods; empty: rows have none
  std::vector<ReportColumn> columns;
  std::vector<ReportRow> rows;
  std::vector<std::string> notes;  // footnote 1, 2, ...

  /// Title with its label: "Accuracy (stand-in)".
  std::string labelled_title() const { return label.empty() ? title : title + " (" + label + ")"; }
  bool has_groups() const;
  /// Number of the footnote with this text, which is added if there is none yet.
  int note_number(const std::string& words);
};

/// Tables that do not depend on the machine's speed, and those that do: the former can be compared byte for byte
/// between two runs.
struct ReportTables {
  std::vector<ReportTable> accuracy;  // sequences, accuracy, summary, ablation, details, maps, paper
  std::vector<ReportTable> speed;     // speed, training
};

ReportTables make_report_tables(const BenchmarkResults& results);

/// The tables of make_report_tables, one function per table.
ReportTable sequences_table(const BenchmarkResults& results);
ReportTable accuracy_table(const BenchmarkResults& results);
ReportTable summary_table(const BenchmarkResults& results);
std::optional<ReportTable> ablation_table(const BenchmarkResults& results);
ReportTable details_table(const BenchmarkResults& results);
ReportTable maps_table(const BenchmarkResults& results);
ReportTable paper_table(const BenchmarkResults& results);
ReportTable speed_table(const BenchmarkResults& results);
ReportTable training_table(const BenchmarkResults& results);

/// Label of the tables with results of this program ("stand-in"); empty: none.
std::string label_of(const BenchmarkResults& results);

/// The value with this number of decimals; "-" if it is not finite.
std::string fixed_text(double value, int decimals);
/// Shortest text that reads back as the same value; empty if it is not finite.
std::string exact_text(double value);

ReportCell words_cell(const std::string& text);
ReportCell number_cell(double value, int decimals);
/// Median over the runs; with its spread if there are several.
ReportCell value_cell(const CellSummary::Value& value, int runs, int decimals);
/// "x" with the reason as its footnote in `table`.
ReportCell failed_cell(ReportTable& table, const std::string& fault);

/// A fact about a report: name "device", value "pthread-haswell".
struct ReportFact {
  std::string name;
  std::string text;
};
/// Protocol, machine, device, version, seeds, command.
std::vector<ReportFact> report_facts(const BenchmarkResults& results);

}  // namespace odosplat::apps
