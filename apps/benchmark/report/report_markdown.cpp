// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cctype>

#include "apps/benchmark/report/report_formats.hpp"

namespace odosplat::apps {
namespace {

/// Escapes Markdown's special characters. Underscores within words are not escaped: Markdown does not interpret them.
std::string markdown_escaped(const std::string& text) {
  const auto in_word = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '|':
      case '*':
      case '`':
      case '\\':
      case '[':
      case ']':
        result += '\\';
        result += c;
        break;
      case '_':
        if (i == 0 || !in_word(i - 1) || !in_word(i + 1)) result += '\\';
        result += c;
        break;
      case '\n':
      case '\r':
        result += ' ';
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string markdown_cell(const ReportCell& cell) {
  std::string text = markdown_escaped(cell.text);
  if (cell.mark == RankMark::best) text = "**" + text + "**";
  if (cell.mark == RankMark::second) text = "<u>" + text + "</u>";
  if (cell.note > 0) text += "<sup>" + std::to_string(cell.note) + "</sup>";
  if (!cell.spread.empty()) text += "<br><small>" + markdown_escaped(cell.spread) + "</small>";
  return text;
}

std::string markdown_table(const ReportTable& table) {
  std::string text = "### " + markdown_escaped(table.labelled_title()) + "\n\n";
  if (!table.caption.empty()) text += markdown_escaped(table.caption) + "\n\n";
  const bool methods = !table.method_head.empty();
  std::string heads = "| " + markdown_escaped(table.row_head) + " |";
  std::string rules = "|---|";
  if (methods) {
    heads += " " + markdown_escaped(table.method_head) + " |";
    rules += "---|";
  }
  for (const ReportColumn& column : table.columns) {
    // Markdown tables have one header row: the group's name goes above the column's own in the same cell.
    heads += " " + (column.group.empty() ? "" : markdown_escaped(column.group) + "<br>") +
             markdown_escaped(column.head) + " |";
    rules += column.words ? "---|" : "---:|";
  }
  text += heads + "\n" + rules + "\n";
  for (const ReportRow& row : table.rows) {
    text += "| " + markdown_escaped(row.name) + " |";
    if (methods) text += " " + markdown_escaped(row.method) + " |";
    for (const ReportCell& cell : row.cells) text += " " + markdown_cell(cell) + " |";
    text += "\n";
  }
  for (std::size_t n = 0; n < table.notes.size(); ++n) {
    text += "\n<sup>" + std::to_string(n + 1) + "</sup> " + markdown_escaped(table.notes[n]) + "\n";
  }
  return text + "\n";
}

}  // namespace

std::string markdown_of(const BenchmarkResults& results, const ReportTables& tables,
                        const std::vector<ReportFigure>& figures) {
  std::string text = "# Benchmark " + markdown_escaped(results.suite) + "\n\n";
  const std::string warning = stand_in_warning(results);
  if (!warning.empty()) text += "> **" + label_of(results) + "**: " + markdown_escaped(warning) + "\n\n";
  for (const ReportFact& fact : report_facts(results)) {
    text += "- " + markdown_escaped(fact.name) + ": " + markdown_escaped(fact.text) + "\n";
  }
  text += "\n## Tables\n\n";
  for (const ReportTable& table : tables.accuracy) text += markdown_table(table);
  if (!figures.empty()) text += "## Figures\n\n";
  for (const ReportFigure& figure : figures) {
    text += "### " + markdown_escaped(figure.title) + "\n\n";
    if (!figure.missing.empty()) {
      text += "Left out: " + markdown_escaped(figure.missing) + "\n\n";
      continue;
    }
    text += "![" + markdown_escaped(figure.title) + "](" + figure.file + ")\n\n" + markdown_escaped(figure.caption) +
            "\n\n";
  }
  text += "## Speed\n\n";
  for (const ReportTable& table : tables.speed) text += markdown_table(table);
  return text;
}

}  // namespace odosplat::apps
