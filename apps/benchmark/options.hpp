// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace odosplat::apps {

/// Options of a benchmark. All but those on how jobs are run (RunnerOptions) are kept in OUT/plan.json.
struct BenchmarkOptions {
  std::string suite;  // synthetic, icl or a suite file
  std::string root;   // folder of recordings
  std::string out;
  std::string cache;                   // folder of rendered stand-ins; empty: see cache_folder()
  std::vector<std::string> methods;    // empty: gaussian, interpolation, surfel, rgbd, paper and the suite's own
  std::vector<std::string> sequences;  // empty: all
  int runs = 1;                        // of each method on each sequence, each with its own seed
  std::string size = "320x240";        // image size of stand-ins
  bool quick = false;                  // 200 frames a sequence, short training
  std::string mapping = "every";       // "every": maps from every tenth frame of the tested sequences; or "split"
  std::uint64_t seed = 1;

  /// Throws InputError naming the flag.
  void check() const;
};

/// How jobs are run. Only times and memory of the results depend on it.
struct RunnerOptions {
  int jobs = 0;                  // at a time; 0: one per core
  int threads = 0;               // of each job; 0: cores / jobs
  double time_limit = 7200.0;    // [s] per job, > 0
  double memory_limit = 8192.0;  // [MB] resident, per job, > 0
  bool retry_failed = false;     // run jobs again that failed before
  std::string device;            // as --device
};

}  // namespace odosplat::apps
