// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "benchmark/report_formats.hpp"

namespace odosplat::apps {
namespace {

std::string escaped(const std::string& text) {
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

/// A comment ends with its line.
std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text;
}

std::string cell_text(const ReportCell& cell) {
  std::string text = cell.failed ? "$\\times$" : escaped(cell.text);
  if (cell.mark == RankMark::best) text = "\\textbf{" + text + "}";
  if (cell.mark == RankMark::second) text = "\\uline{" + text + "}";
  if (cell.note > 0) text += "$^{" + std::to_string(cell.note) + "}$";
  if (!cell.spread.empty()) text = "\\shortstack{" + text + "\\\\{\\tiny " + escaped(cell.spread) + "}}";
  return text;
}

/// A wide table gets small letters: no package that scales is asked for.
std::string letters_for(std::size_t columns) {
  if (columns <= 8) return "\\footnotesize";
  if (columns <= 12) return "\\scriptsize\\setlength{\\tabcolsep}{3pt}";
  return "\\tiny\\setlength{\\tabcolsep}{2pt}";
}

std::string group_heads(const ReportTable& table, std::size_t names) {
  std::string heads;
  std::string rules;
  for (std::size_t k = 0; k < names; ++k) heads += k > 0 ? " & " : "";
  for (std::size_t begin = 0; begin < table.columns.size();) {
    std::size_t end = begin;
    while (end < table.columns.size() && table.columns[end].group == table.columns[begin].group) ++end;
    const std::string& group = table.columns[begin].group;
    heads += " & \\multicolumn{" + std::to_string(end - begin) + "}{c}{" + escaped(group) + "}";
    if (!group.empty()) {
      rules += "\\cmidrule(lr){" + std::to_string(names + begin + 1) + "-" + std::to_string(names + end) + "}";
    }
    begin = end;
  }
  return heads + " \\\\\n" + rules + "\n";
}

std::string table_text(const ReportTable& table) {
  const std::size_t names = table.method_head.empty() ? 1 : 2;
  std::string columns(names, 'l');
  for (const ReportColumn& column : table.columns) columns += column.words ? 'l' : 'r';
  std::string text = "\\begin{table*}\n\\centering\n" + letters_for(columns.size()) + "\n";
  text += "\\caption{" + escaped(table.labelled_title()) + "." + (table.caption.empty() ? "" : " ") +
          escaped(table.caption) + "}\n\\label{tab:" + table.key + "}\n";
  text += "\\begin{tabular}{" + columns + "}\n\\toprule\n";
  if (table.has_groups()) text += group_heads(table, names);
  text += escaped(table.row_head);
  if (names == 2) text += " & " + escaped(table.method_head);
  for (const ReportColumn& column : table.columns) text += " & " + escaped(column.head);
  text += " \\\\\n\\midrule\n";
  for (const ReportRow& row : table.rows) {
    text += escaped(row.name);
    if (names == 2) text += " & " + escaped(row.method);
    for (const ReportCell& cell : row.cells) text += " & " + cell_text(cell);
    text += " \\\\\n";
  }
  text += "\\bottomrule\n\\end{tabular}\n";
  for (std::size_t n = 0; n < table.notes.size(); ++n) {
    text += "\\par\\footnotesize $^{" + std::to_string(n + 1) + "}$ " + escaped(table.notes[n]) + "\n";
  }
  return text + "\\end{table*}\n";
}

}  // namespace

std::string tex_of(const std::vector<ReportTable>& tables, const BenchmarkResults& results) {
  std::string text = "% For \\input in a document with \\usepackage{booktabs} and \\usepackage[normalem]{ulem}.\n";
  if (results.stand_in) text += "% " + one_line(stand_in_warning(results)) + "\n";
  for (const ReportTable& table : tables) text += "\n" + table_text(table);
  return text;
}

}  // namespace odosplat::apps
