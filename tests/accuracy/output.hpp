// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/accuracy/judge.hpp"

namespace odosplat::accuracy {

/// One row of a table: cells with the name of their column, which holds the unit ("ate_mm").
class Row {
 public:
  Row& text(const std::string& column, const std::string& value);
  Row& count(const std::string& column, long value);
  /// Shown with that many decimals, kept whole in the JSON; "-" and null where it is not finite.
  Row& number(const std::string& column, double value, int decimals);
  /// Shown as yes or no.
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

/// Where results go: rows to standard output as they come, under a line of column names wherever those change; with
/// --json all rows, and with --trace the frames of all runs, to files when write() is called.
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
  std::vector<std::string> columns_;  // of the table that is being printed
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
  std::string trace_;
};

/// The cells that all tables have in common: set, what was run, lost, errors.
Row row_of(const World& world, const std::string& scenario, const Judged& judged);

}  // namespace odosplat::accuracy
