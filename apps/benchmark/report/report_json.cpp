// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <nlohmann/json.hpp>

#include "apps/benchmark/report/report_formats.hpp"
#include "apps/command/json_text.hpp"

namespace odosplat::apps {
namespace {

using Json = nlohmann::ordered_json;

Json table_json(const ReportTable& table) {
  Json cells = Json::array();
  for (const ReportRow& row : table.rows) {
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const ReportCell& cell = row.cells[c];
      const ReportColumn& column = table.columns[c];
      Json json{{"row", row.name}};
      const std::string& method = column.method.empty() ? row.method : column.method;
      if (!method.empty()) json["method"] = method;
      json["quantity"] = column.quantity;
      json["value"] = cell.value ? Json(*cell.value) : column.words && !cell.failed ? Json(cell.text) : Json(nullptr);
      if (cell.low && cell.high) {
        json["low"] = *cell.low;
        json["high"] = *cell.high;
      }
      json["printed"] = cell.text;
      if (cell.mark != RankMark::none) json["mark"] = mark_word(cell.mark);
      if (cell.note > 0) json["note"] = table.notes[static_cast<std::size_t>(cell.note) - 1];
      cells.push_back(std::move(json));
    }
  }
  return {{"title", table.title}, {"caption", table.caption}, {"label", table.label}, {"cells", std::move(cells)}};
}

Json tables_json(const std::vector<ReportTable>& tables) {
  Json json = Json::object();
  for (const ReportTable& table : tables) json[table.key] = table_json(table);
  return json;
}

Json statistics_json(const Statistics& s) {
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"max", s.max}, {"p99", s.p99}};
}

Json run_json(const RunFacts& run) {
  Json json{{"sequence", run.sequence}, {"method", run.method}, {"run", run.run}, {"seed", run.seed}};
  if (!run.fault.empty()) {
    json["fault"] = run.fault;
    return json;
  }
  json["frames"] = run.frames;
  json["posed"] = run.posed;
  json["lost"] = run.lost;
  json["relocalisations"] = run.relocalisations;
  json["coverage"] = run.unaligned.coverage;
  json["ate_m"] = statistics_json(run.unaligned.ate_m);
  json["rte_m"] = statistics_json(run.unaligned.rte_m);
  json["rre_deg"] = statistics_json(run.unaligned.rre_deg);
  json["ate_aligned_m"] = statistics_json(run.aligned.ate_m);
  json["ate_live_m"] = run.live_ate_m;
  return json;
}

Json run_speed_json(const RunFacts& run) {
  return {{"sequence", run.sequence},
          {"method", run.method},
          {"run", run.run},
          {"ms_per_frame", run.ms_per_frame},
          {"p95_ms", run.p95_ms},
          {"cpu_ms_per_frame", run.cpu_ms},
          {"peak_memory_mb", run.peak_memory_mb}};
}

}  // namespace

std::string json_of(const BenchmarkResults& results, const ReportTables& tables) {
  Json runs = Json::array();
  Json run_speeds = Json::array();
  for (const RunFacts& run : results.cells) {
    runs.push_back(run_json(run));
    if (run.fault.empty()) run_speeds.push_back(run_speed_json(run));
  }
  const Json json{{"suite", results.suite},
                  {"label", label_of(results)},
                  {"warning", stand_in_warning(results)},
                  {"mapping", results.mapping},
                  {"split", results.split},
                  {"quick", results.quick},
                  {"methods", results.methods},
                  {"runs_of_each_cell", results.runs},
                  {"machine", results.machine},
                  {"device", results.device},
                  {"version", results.version},
                  {"command", results.command},
                  {"tables", tables_json(tables.accuracy)},
                  {"runs", std::move(runs)},
                  {"speed", {{"tables", tables_json(tables.speed)}, {"runs", std::move(run_speeds)}}}};
  return json_text(json);
}

}  // namespace odosplat::apps
