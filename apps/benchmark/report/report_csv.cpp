// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/report_formats.hpp"

namespace odosplat::apps {
namespace {

/// A field quoted as RFC 4180 says.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string exact_or_empty(const std::optional<double>& value) { return value ? exact_text(*value) : ""; }

}  // namespace

std::string csv_of(const std::vector<ReportTable>& tables) {
  std::string text = "table,row,method,quantity,value,low,high,printed,mark,note,label\n";
  for (const ReportTable& table : tables) {
    for (const ReportRow& row : table.rows) {
      for (std::size_t c = 0; c < row.cells.size(); ++c) {
        const ReportCell& cell = row.cells[c];
        const ReportColumn& column = table.columns[c];
        const bool words = column.words && !cell.failed;
        const std::string note = cell.note > 0 ? table.notes[static_cast<std::size_t>(cell.note) - 1] : "";
        for (const std::string& part :
             {table.key, row.name, column.method.empty() ? row.method : column.method, column.quantity,
              words ? cell.text : exact_or_empty(cell.value), exact_or_empty(cell.low), exact_or_empty(cell.high),
              cell.text, mark_word(cell.mark), note}) {
          text += field(part) + ",";
        }
        text += field(table.label) + "\n";
      }
    }
  }
  return text;
}

}  // namespace odosplat::apps
