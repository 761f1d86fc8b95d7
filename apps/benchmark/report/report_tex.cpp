// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>

#include "apps/benchmark/report/report_formats.hpp"

namespace odosplat::apps {
namespace {

std::string tex_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '_':
      case '%':
      case '&':
      case '#':
      case '$':
      case '{':
      case '}':
        result += '\\';
        result += c;
        break;
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      case '|':
        result += "\\textbar{}";
        break;
      case '`':
        result += "\\textasciigrave{}";
        break;
      case '"':
        result += "\\textquotedbl{}";
        break;
      case '\n':
      case '\r':
      case '\t':
        result += ' ';
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// Without line breaks: a comment of TeX ends at the end of its line.
std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text;
}

std::string tex_cell(const ReportCell& cell) {
  std::string text = cell.failed ? "$\\times$" : tex_escaped(cell.text);
  if (cell.mark == RankMark::best) text = "\\textbf{" + text + "}";
  if (cell.mark == RankMark::second) text = "\\uline{" + text + "}";
  if (cell.note > 0) text += "$^{" + std::to_string(cell.note) + "}$";
  if (!cell.spread.empty()) text = "\\shortstack{" + text + "\\\\{\\tiny " + tex_escaped(cell.spread) + "}}";
  return text;
}

/// Font size by the number of columns, so that wide tables fit without a package for scaling.
std::string letters_for(std::size_t columns) {
  if (columns <= 8) return "\\footnotesize";
  if (columns <= 12) return "\\scriptsize\\setlength{\\tabcolsep}{3pt}";
  if (columns <= 14) return "\\tiny\\setlength{\\tabcolsep}{2pt}";
  return "\\tiny\\setlength{\\tabcolsep}{1.4pt}";
}

std::string group_heads(const ReportTable& table, std::size_t names) {
  std::string heads;
  std::string rules;
  for (std::size_t k = 0; k < names; ++k) heads += k > 0 ? " & " : "";
  for (std::size_t begin = 0; begin < table.columns.size();) {
    std::size_t end = begin;
    while (end < table.columns.size() && table.columns[end].group == table.columns[begin].group) ++end;
    const std::string& group = table.columns[begin].group;
    heads += " & \\multicolumn{" + std::to_string(end - begin) + "}{c}{" + tex_escaped(group) + "}";
    if (!group.empty()) {
      rules += "\\cmidrule(lr){" + std::to_string(names + begin + 1) + "-" + std::to_string(names + end) + "}";
    }
    begin = end;
  }
  return heads + " \\\\\n" + rules + "\n";
}

std::string tex_table(const ReportTable& table) {
  const std::size_t names = table.method_head.empty() ? 1 : 2;
  std::string columns(names, 'l');
  for (const ReportColumn& column : table.columns) columns += column.words ? 'l' : 'r';
  std::string text = "\\begin{table*}\n\\centering\n" + letters_for(columns.size()) + "\n";
  text += "\\caption{" + tex_escaped(table.labelled_title()) + "." + (table.caption.empty() ? "" : " ") +
          tex_escaped(table.caption) + "}\n\\label{tab:" + table.key + "}\n";
  text += "\\begin{tabular}{" + columns + "}\n\\toprule\n";
  if (table.has_groups()) text += group_heads(table, names);
  text += tex_escaped(table.row_head);
  if (names == 2) text += " & " + tex_escaped(table.method_head);
  for (const ReportColumn& column : table.columns) text += " & " + tex_escaped(column.head);
  text += " \\\\\n\\midrule\n";
  for (const ReportRow& row : table.rows) {
    text += tex_escaped(row.name);
    if (names == 2) text += " & " + tex_escaped(row.method);
    for (const ReportCell& cell : row.cells) text += " & " + tex_cell(cell);
    text += " \\\\\n";
  }
  text += "\\bottomrule\n\\end{tabular}\n";
  for (std::size_t n = 0; n < table.notes.size(); ++n) {
    text += "\\par\\footnotesize $^{" + std::to_string(n + 1) + "}$ " + tex_escaped(table.notes[n]) + "\n";
  }
  return text + "\\end{table*}\n";
}

/// The columns of one group as a table of its own, with the group's name in the title.
ReportTable part_of(const ReportTable& table, const std::string& group, std::size_t number) {
  ReportTable part = table;
  part.key += "_" + std::to_string(number);
  part.title += ": " + group;
  part.columns.clear();
  for (ReportRow& row : part.rows) row.cells.clear();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].group != group) continue;
    part.columns.push_back(table.columns[c]);
    part.columns.back().group.clear();
    for (std::size_t r = 0; r < part.rows.size(); ++r) part.rows[r].cells.push_back(table.rows[r].cells[c]);
  }
  return part;
}

bool too_wide(const ReportTable& table) {
  constexpr std::size_t columns_with_spread = 8;
  const bool spread = std::ranges::any_of(table.rows, [](const ReportRow& row) {
    return std::ranges::any_of(row.cells, [](const ReportCell& cell) { return !cell.spread.empty(); });
  });
  return table.has_groups() && spread && table.columns.size() > columns_with_spread;
}

/// With spreads, the groups are too wide to stand side by side: then each group becomes a table of its own.
std::string table_or_parts(const ReportTable& table) {
  if (!too_wide(table)) return tex_table(table);
  std::string text;
  std::vector<std::string> groups;
  for (const ReportColumn& column : table.columns) {
    if (std::ranges::find(groups, column.group) != groups.end()) continue;
    groups.push_back(column.group);
    text += (text.empty() ? "" : "\n") + tex_table(part_of(table, column.group, groups.size()));
  }
  return text;
}

}  // namespace

std::string tex_of(const std::vector<ReportTable>& tables, const BenchmarkResults& results) {
  std::string text = "% For \\input in a document with \\usepackage{booktabs} and \\usepackage[normalem]{ulem}.\n";
  if (results.stand_in) text += "% " + one_line(stand_in_warning(results)) + "\n";
  for (const ReportTable& table : tables) text += "\n" + table_or_parts(table);
  return text;
}

}  // namespace odosplat::apps
