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
  std::string words;   // of the scene
  std::string path;    // folder, absolute
  std::string frames;  // "A:B" that are tested; empty: all
  bool stand_in = false;
  std::string job;         // that renders it; empty: it is there
  std::string check_job;   // of its conventions
  std::string check_file;  // JSON that this writes
  std::string map;         // name of the map that it is tested in
  std::string map_file;    // of our own preset; empty: no method here uses one
  std::string cloud_file;  // likewise
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
  std::string mapping;  // the protocol in a sentence
  std::string quick;    // what was cut short, in words; empty: nothing
  std::vector<std::string> methods;
  std::vector<PlannedSequence> sequences;  // tested
  std::vector<PlannedMap> maps;
  std::vector<PlannedRun> runs;
  std::vector<Job> jobs;  // each behind those it needs
};

/// What has to be done for these options. The same options and suite give the same plan. Recorded sequences must be
/// there (InputError); nothing is run or written.
Plan make_plan(const BenchmarkOptions& options);

/// OUT/plan.json: the options, and the jobs for whoever schedules them (`odosplat benchmark --out OUT --job ID`).
void write_plan(const Plan& plan);
/// The plan of a folder, made again from the options kept there. InputError if there is none.
Plan read_plan(const std::string& out);

/// Where stand-ins are kept for all benchmarks: the cache given, else ODOSPLAT_CACHE_DIR, $XDG_CACHE_HOME/odosplat or
/// $HOME/.cache/odosplat, each with /stand-ins. InputError if there is none of these.
std::string cache_folder(const BenchmarkOptions& options);

}  // namespace odosplat::apps
