// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/accuracy/judge.hpp"

namespace odosplat::accuracy {

/// One row of a table: cells with the names of their columns, which contain the unit ("ate_mm").
class Row {
 public:
  Row& text(const std::string& column, const std::string& value);
  Row& count(const std::string& column, long value);
  /// Printed with this number of decimals, at full precision in the JSON; "-" and null if it is not finite.
  Row& number(const std::string& column, double value, int decimals);
  /// Printed as yes or no.
  Row& flag(const std::string& column, bool value);

 private:
  friend class Output;
  struct Cell {
    std::string column;
    std::string shown;
    nlohmann::ordered_json value;
  };
  std::vector<Cell> cells_;
};

/// Output of results: rows are printed to standard output as they are added, below a line of column names whenever
/// these change. write() writes all rows to the file of --json, and the frames of all runs to that of --trace.
class Output {
 public:
  /// InputError if a file cannot be written there.
  explicit Output(const Job& job);

  void add(const Row& row);
  void trace(const World& world, const std::string& run_name, const Run& run);
  void write() const;

 private:
  std::string json_file_;
  std::string trace_file_;
  std::vector<std::string> columns_;  // of the table being printed
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
  std::string trace_;
};

/// The cells common to all tables: data set, scenario, lost frames, errors.
Row row_of(const World& world, const std::string& scenario, const Judged& judged);

}  // namespace odosplat::accuracy
