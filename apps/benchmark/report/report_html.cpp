// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/report_formats.hpp"
#include "apps/command/html_text.hpp"
#include "odosplat/core/base64.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light; }
body { font: 16px/1.45 system-ui, sans-serif; color: #1a1a1a; background: #fff; margin: 0 auto; max-width: 75rem;
  padding: 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.3rem; margin-top: 2.2rem; border-bottom: 1px solid #bbb; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .3rem; }
p { max-width: 48rem; margin: .3rem 0; }
.warning { border: 2px solid #b05000; background: #fff6ea; padding: .6rem .8rem; max-width: none; }
.label { font-size: .8rem; border: 1px solid #b05000; color: #8a3f00; border-radius: .3rem; padding: 0 .35rem;
  font-weight: 600; white-space: nowrap; }
.scroll { overflow-x: auto; margin: .6rem 0; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; }
th, td { padding: .22rem .6rem; text-align: right; white-space: nowrap; vertical-align: top; }
th { font-weight: 600; } thead th { vertical-align: bottom; }
th.name, td.words, th.words { text-align: left; }
th.name:first-child { position: sticky; left: 0; background: #fff; }
thead tr:first-child th { border-top: 2px solid #333; } thead tr:last-child th { border-bottom: 1px solid #333; }
tbody tr:last-child > * { border-bottom: 2px solid #333; }
tbody tr:nth-child(even), tbody tr:nth-child(even) th.name { background: #f5f5f5; }
th.group { text-align: center; border-bottom: 1px solid #999; }
.first { border-left: 1px solid #ccc; }
td small { display: block; color: #555; font-size: .8em; }
sup { font-size: .7em; line-height: 0; }
.note { font-size: .85rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem .9rem; }
dt { font-weight: 600; } dd { margin: 0; overflow-wrap: anywhere; }
figure { margin: .8rem 0; } img { max-width: min(100%, 42rem); height: auto; } img.wide { max-width: 100%; }
figcaption { max-width: 48rem; }
@media (max-width: 40rem) { dl { grid-template-columns: 1fr; } dd { margin-bottom: .4rem; } }
@media print {
  body { font-size: 9pt; max-width: none; padding: 0; } .scroll { overflow: visible; }
  table { font-size: 8pt; } th, td { padding: .1rem .35rem; } table.wide { font-size: 5.5pt; }
  th.name:first-child { position: static; }
  table.wide th, table.wide td { padding: .1rem .18rem; } table.wide small { white-space: normal; } figure, tr { break-inside: avoid; } img { max-width: 12cm; }
  h2, h3 { break-after: avoid; }
}
)";

std::string label_text(const std::string& label) {
  return label.empty() ? "" : " <span class=\"label\">" + html_escaped(label) + "</span>";
}

std::string html_cell(const ReportCell& cell) {
  std::string text = html_escaped(cell.text);
  if (cell.mark == RankMark::best) text = "<b>" + text + "</b>";
  if (cell.mark == RankMark::second) text = "<u>" + text + "</u>";
  if (cell.note > 0) text += "<sup>" + std::to_string(cell.note) + "</sup>";
  if (!cell.spread.empty()) {
    // A permitted line break within the spread, for wide tables in print, where nothing scrolls.
    std::string spread = html_escaped(cell.spread);
    spread.insert(spread.find("..") + 2, "<wbr>");
    text += "<small>" + spread + "</small>";
  }
  return text;
}

bool opens_group(const ReportTable& table, std::size_t column) {
  return table.has_groups() && (column == 0 || table.columns[column].group != table.columns[column - 1].group);
}

std::string classes(const ReportTable& table, std::size_t column) {
  std::string names = table.columns[column].words ? "words" : "";
  if (opens_group(table, column)) names += names.empty() ? "first" : " first";
  return names.empty() ? "" : " class=\"" + names + "\"";
}

std::string heads_text(const ReportTable& table) {
  std::string text = "<thead>\n";
  const std::string rows = table.has_groups() ? " rowspan=\"2\"" : "";
  text += "<tr><th class=\"name\"" + rows + ">" + html_escaped(table.row_head) + "</th>";
  if (!table.method_head.empty()) text += "<th class=\"name\"" + rows + ">" + html_escaped(table.method_head) + "</th>";
  if (table.has_groups()) {
    for (std::size_t begin = 0; begin < table.columns.size();) {
      std::size_t end = begin + 1;
      while (end < table.columns.size() && !opens_group(table, end)) ++end;
      text += "<th class=\"group first\" colspan=\"" + std::to_string(end - begin) + "\">" +
              html_escaped(table.columns[begin].group) + "</th>";
      begin = end;
    }
    text += "</tr>\n<tr>";
  }
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    text += "<th" + classes(table, c) + ">" + html_escaped(table.columns[c].head) + "</th>";
  }
  return text + "</tr>\n</thead>\n";
}

std::string html_table(const ReportTable& table) {
  std::string text = "<h3>" + html_escaped(table.title) + label_text(table.label) + "</h3>\n";
  if (!table.caption.empty()) text += "<p>" + html_escaped(table.caption) + "</p>\n";
  const bool wide = table.columns.size() > 12;
  text += std::string("<div class=\"scroll\" tabindex=\"0\"><table") + (wide ? " class=\"wide\"" : "") + ">\n" +
          heads_text(table) + "<tbody>\n";
  for (const ReportRow& row : table.rows) {
    text += "<tr><th class=\"name\">" + html_escaped(row.name) + "</th>";
    if (!table.method_head.empty()) text += "<td class=\"words\">" + html_escaped(row.method) + "</td>";
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      text += "<td" + classes(table, c) + ">" + html_cell(row.cells[c]) + "</td>";
    }
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
  for (std::size_t n = 0; n < table.notes.size(); ++n) {
    text += "<p class=\"note\"><sup>" + std::to_string(n + 1) + "</sup> " + html_escaped(table.notes[n]) + "</p>\n";
  }
  return text;
}

std::string figure_text(const ReportFigure& figure, const std::string& folder) {
  std::string text = "<h3>" + html_escaped(figure.title) + "</h3>\n";
  if (!figure.missing.empty()) return text + "<p>Left out: " + html_escaped(figure.missing) + "</p>\n";
  return text + "<figure><img" + (figure.wide ? " class=\"wide\"" : "") + " alt=\"" + html_escaped(figure.title) +
         "\" src=\"data:image/png;base64," + base64(read_file(folder + "/" + figure.file)) + "\">\n<figcaption>" +
         html_escaped(figure.caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string html_of(const BenchmarkResults& results, const ReportTables& tables,
                    const std::vector<ReportFigure>& figures, const std::string& folder) {
  const std::string title = "Benchmark " + html_escaped(results.suite);
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + title + label_text(label_of(results)) +
      "</h1>\n";
  const std::string warning = stand_in_warning(results);
  if (!warning.empty()) text += "<p class=\"warning\">" + html_escaped(warning) + "</p>\n";
  text += "<dl>\n";
  for (const ReportFact& fact : report_facts(results)) {
    text += "<dt>" + html_escaped(fact.name) + "</dt><dd>" + html_escaped(fact.text) + "</dd>\n";
  }
  text += "</dl>\n<h2>Tables</h2>\n";
  for (const ReportTable& table : tables.accuracy) text += html_table(table);
  if (!figures.empty()) text += "<h2>Figures</h2>\n";
  for (const ReportFigure& figure : figures) text += figure_text(figure, folder);
  text += "<h2>Speed</h2>\n";
  for (const ReportTable& table : tables.speed) text += html_table(table);
  return text + "</body>\n</html>\n";
}

}  // namespace odosplat::apps
