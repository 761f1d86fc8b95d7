// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The tables of sequences, maps and speed.
#include "apps/benchmark/report/report_table.hpp"

namespace odosplat::apps {
namespace {

std::string map_words(const MapFacts& map) { return map.preset.empty() ? "default" : map.preset; }

}  // namespace

ReportTable sequences_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "sequences";
  table.title = "Sequences (the paper's Table 1)";
  table.caption =
      "Length of the true path from frame to frame. Texture: share of the pixels whose grey changes by more than 8 of "
      "255 levels a pixel. Checksum: of images and truth. Check: what odosplat check says of poses and depth.";
  table.label = label_of(results);
  table.row_head = "Sequence";
  table.columns = {{"", "scene", "", "scene", true},       {"", "frames", "", "frames"},
                   {"", "time (s)", "", "duration_s"},     {"", "length (m)", "", "length_m"},
                   {"", "size (px)", "", "size_px", true}, {"", "texture (%)", "", "texture_percent"},
                   {"", "checksum", "", "checksum", true}, {"", "check", "", "check", true}};
  for (const SequenceFacts& s : results.sequences) {
    ReportRow row;
    row.name = s.name;
    row.cells.push_back(words_cell(s.words.empty() ? s.scene : s.words));
    if (!s.fault.empty()) {
      while (row.cells.size() < table.columns.size()) row.cells.push_back(failed_cell(table, s.fault));
      table.rows.push_back(std::move(row));
      continue;
    }
    row.cells.push_back(number_cell(s.frames, 0));
    row.cells.push_back(number_cell(s.seconds, 1));
    row.cells.push_back(number_cell(s.length_m, 2));
    row.cells.push_back(words_cell(std::to_string(s.width) + "x" + std::to_string(s.height)));
    row.cells.push_back(s.texture < 0.0 ? words_cell("-") : number_cell(100.0 * s.texture, 1));
    row.cells.push_back(words_cell(s.checksum.empty() ? "-" : s.checksum));
    row.cells.push_back(words_cell(s.convention.empty() ? "-" : s.convention));
    // A suite may mix stand-ins and recorded sequences: the table's label does not tell which rows are stand-ins.
    if (s.stand_in) row.cells.front().note = table.note_number("stand-in, made by this program");
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable maps_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "maps";
  table.title = "Maps";
  table.caption = "PSNR: of the map's colours on its training images.";
  table.label = label_of(results);
  table.row_head = "Map";
  table.method_head = "Preset";
  table.columns = {
      {"", "Gaussians", "", "gaussians"}, {"", "iterations", "", "iterations"}, {"", "PSNR (dB)", "", "psnr_db"}};
  for (const MapFacts& map : results.maps) {
    ReportRow row{map.name, map_words(map), {}};
    if (!map.fault.empty()) {
      while (row.cells.size() < table.columns.size()) row.cells.push_back(failed_cell(table, map.fault));
    } else {
      row.cells.push_back(number_cell(static_cast<double>(map.gaussians), 0));
      row.cells.push_back(number_cell(map.iterations, 0));
      row.cells.push_back(number_cell(map.psnr_db, 2));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable speed_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "speed";
  table.title = "Time and memory of tracking";
  table.caption =
      "Time a frame on the wall's clock (median and 95th percentile) and of all threads together (mean); largest "
      "memory "
      "of the process.";
  if (results.runs > 1) table.caption += " Median over " + std::to_string(results.runs) + " runs.";
  table.label = label_of(results);
  table.row_head = "Sequence";
  table.method_head = "Method";
  table.columns = {{"", "median (ms)", "", "ms_per_frame"},
                   {"", "95 % (ms)", "", "p95_ms"},
                   {"", "CPU (ms)", "", "cpu_ms_per_frame"},
                   {"", "memory (MB)", "", "peak_memory_mb"}};
  for (const SequenceFacts& sequence : results.sequences) {
    for (const std::string& method : results.methods) {
      const auto summary = summarise(results, sequence.name, method);
      if (!summary) continue;
      ReportRow row{sequence.name, method, {}};
      if (summary->runs == 0) {
        while (row.cells.size() < table.columns.size()) row.cells.push_back(failed_cell(table, summary->fault));
      } else {
        row.cells.push_back(value_cell(summary->ms_per_frame, summary->runs, 1));
        row.cells.push_back(value_cell(summary->p95_ms, summary->runs, 1));
        row.cells.push_back(value_cell(summary->cpu_ms, summary->runs, 1));
        row.cells.push_back(value_cell(summary->peak_memory_mb, summary->runs, 0));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

ReportTable training_table(const BenchmarkResults& results) {
  ReportTable table;
  table.key = "training";
  table.title = "Time and memory of training";
  table.label = label_of(results);
  table.row_head = "Map";
  table.method_head = "Preset";
  table.columns = {{"", "time (s)", "", "seconds"}, {"", "memory (MB)", "", "peak_memory_mb"}};
  for (const MapFacts& map : results.maps) {
    ReportRow row{map.name, map_words(map), {}};
    if (!map.fault.empty()) {
      while (row.cells.size() < table.columns.size()) row.cells.push_back(failed_cell(table, map.fault));
    } else {
      row.cells.push_back(number_cell(map.seconds, 0));
      row.cells.push_back(number_cell(map.peak_memory_mb, 0));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace odosplat::apps
