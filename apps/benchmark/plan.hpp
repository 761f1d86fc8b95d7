// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/benchmark/job.hpp"
#include "apps/benchmark/options.hpp"
#include "apps/benchmark/suite.hpp"

namespace odosplat::apps {

/// A sequence of a benchmark, recorded or to be rendered.
struct PlannedSequence {
  std::string name;
  std::string scene;
  std::string words;   // name of the scene in tables
  std::string path;    // folder, absolute
  std::string frames;  // "A:B", range that is tested; empty: all
  bool stand_in = false;
  std::string job;         // that renders it; empty: none, the sequence exists
  std::string check_job;   // that checks its conventions
  std::string check_file;  // JSON file that check_job writes
  std::string map;         // name of the map that it is tested in
  std::string map_file;    // map of the default preset; empty: no method here uses one
  std::string cloud_file;  // its cloud; empty likewise
};

struct PlannedMap {
  std::string name;
  std::string preset;  // default or paper
  std::string file;
  std::string report;  // JSON
  std::string job;
};

/// One run of a method on a sequence.
struct PlannedRun {
  std::string sequence;
  std::string method;
  int run = 1;
  std::uint64_t seed = 1;
  std::string folder;  // with trajectory.txt and report.json
  std::string job;
};

struct Plan {
  BenchmarkOptions options;
  std::string suite;
  bool stand_in = false;
  std::string mapping;  // the mapping protocol in a sentence
  std::string quick;    // what --quick shortened, in words; empty: nothing
  std::vector<std::string> methods;
  std::vector<PlannedSequence> sequences;  // the tested ones
  std::vector<PlannedMap> maps;
  std::vector<PlannedRun> runs;
  std::vector<Job> jobs;  // each after those it needs
};

/// Makes the plan for these options. The same options and suite give the same plan. Recorded sequences must exist
/// (InputError); nothing is run or written.
Plan make_plan(const BenchmarkOptions& options);

/// Writes OUT/plan.json: the options, and the jobs for external schedulers (`odosplat benchmark --out OUT --job ID`).
void write_plan(const Plan& plan);
/// Makes the plan of a folder again from the options in its plan.json. InputError if there is none.
Plan read_plan(const std::string& out);

/// Folder of rendered stand-ins, shared by all benchmarks: the --cache option, else the subfolder stand-ins of
/// ODOSPLAT_CACHE_DIR, $XDG_CACHE_HOME/odosplat or $HOME/.cache/odosplat. InputError if none of these is set.
std::string cache_folder(const BenchmarkOptions& options);

}  // namespace odosplat::apps
