// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/eval/evaluate.hpp"

/// Results of a benchmark as the reports print them: plain data, possibly incomplete. A run that has not been made, or
/// that crashed, is included with its reason.
namespace odosplat::apps {

/// A row of the table of sequences (the paper's Table 1).
struct SequenceFacts {
  std::string name;   // "icl_1"
  std::string scene;  // "living_room": sequences of one scene share a world frame
  std::string words;  // name of the scene in tables
  std::string path;   // folder
  int frames = 0;     // images
  double seconds = 0.0;
  double length_m = 0.0;   // of the true path, sum over consecutive frames
  int width = 0;           // [px]
  int height = 0;          // [px]
  std::string checksum;    // of the bytes of images and truth, hexadecimal; empty: unknown
  std::string convention;  // verdict of `odosplat check` in one line; empty: not checked
  double texture = -1.0;   // share of pixels with a gradient over 8 grey levels per pixel; < 0: unknown
  bool stand_in = false;   // rendered by this program in place of the data set of that name
  std::string fault;       // why the facts are missing; empty: they are present
  Trajectory truth;        // T_world_camera of its images
};

/// A map that was trained.
struct MapFacts {
  std::string name;    // "living_room"; with --mapping split "living_room_a"
  std::string preset;  // "default" or "paper"
  std::size_t gaussians = 0;
  int iterations = 0;
  double seconds = 0.0;
  double psnr_db = 0.0;  // on the training images
  double peak_memory_mb = 0.0;
  std::string fault;  // why there is no map; empty: there is one
};

/// One run of one method on one sequence.
struct RunFacts {
  std::string sequence;
  std::string method;
  int run = 1;             // 1 .. runs
  std::uint64_t seed = 0;  // of the run
  std::string fault;       // "killed by signal 11 (Segmentation fault)", "over 3600 s", "not run yet"; empty: it ran
  // The following fields are valid only if fault is empty.
  int frames = 0;
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  EvalResult unaligned;       // final trajectory against the truth, in the map's frame
  EvalResult aligned;         // the same after an SE(3) alignment
  double live_ate_m = 0.0;    // RMSE of the poses reported while tracking (before later refinement), unaligned
  double ms_per_frame = 0.0;  // wall time, median
  double p95_ms = 0.0;        // wall time, 95th percentile
  double cpu_ms = 0.0;        // CPU time of all threads, mean
  double peak_memory_mb = 0.0;
  Trajectory estimate;
};

struct BenchmarkResults {
  std::string suite;                 // "synthetic", "icl", or the name in the suite file
  bool stand_in = false;             // sequences are stand-ins: labelled wherever numbers appear
  std::string mapping;               // protocol in a sentence: which frames and clouds the maps are made of
  bool split = false;                // --mapping split: no tested sequence's images in its map
  std::string quick;                 // what --quick shortened, in words; empty: nothing
  std::vector<std::string> methods;  // in the requested order; "gaussian" is this project's own
  int runs = 1;
  std::vector<SequenceFacts> sequences;
  std::vector<MapFacts> maps;
  std::vector<RunFacts> cells;  // every (sequence, method, run), in that order
  std::string machine;          // processor, number of cores
  std::string device;           // OpenCL device
  std::string version;          // of odosplat
  std::string command;          // command line that reproduces these results
};

/// The runs of one method on one sequence combined: median and spread over those that succeeded.
struct CellSummary {
  int runs = 0;       // number that succeeded
  int failed = 0;     // number that failed
  std::string fault;  // of the first failed run
  struct Value {
    double median = 0.0;
    double low = 0.0;
    double high = 0.0;
  };
  Value ate_m, ate_aligned_m, live_ate_m, ate_max_m, rte_m, rre_deg, coverage, lost, ms_per_frame, p95_ms, cpu_ms,
      peak_memory_mb;
  bool complete() const { return runs > 0 && failed == 0; }
};

/// Summary of a cell; none if it has no run in the results.
std::optional<CellSummary> summarise(const BenchmarkResults& results, const std::string& sequence,
                                     const std::string& method);

/// Ranks 1 (best) and 2 of methods by their values, the smallest first, compared as printed. Methods whose values print
/// alike share a rank; after two of rank 1 there is no rank 2, as in the paper's tables. 0 for all others and for those
/// without a value.
std::vector<int> places(const std::vector<std::optional<double>>& values, int decimals);

/// A value of the paper's tables.
struct PaperRow {
  const char* sequence;
  const char* method;
  double ate_m;  // < 0: crashed
  double rte_m;
  double rre_deg;
};

/// Table 2 of the GS-DSO paper (MonoGS's row included) and the interpolation column of its Table 3.
const std::vector<PaperRow>& paper_rows();

}  // namespace odosplat::apps
