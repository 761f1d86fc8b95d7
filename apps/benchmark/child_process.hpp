// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace odosplat::apps {

struct ProcessLimits {
  double seconds = 7200.0;    // wall time
  double memory_mb = 8192.0;  // resident, of the process and all below it
};

struct ProcessEnd {
  std::string fault;  // a line; empty: it ended with status 0
  double seconds = 0.0;
  double peak_memory_mb = 0.0;  // largest resident size seen
};

/// A program run beside this one, apart from the terminal's Ctrl-C, its output going to a file. It is stopped at its
/// limits. With it, or with this process however that ends, all its children end, those included that moved to a
/// session of their own. Linux. Not thread safe.
class ChildProcess {
 public:
  /// command: program (looked up in PATH unless it has a slash) and arguments. log: made anew; its folder must exist. A
  /// program that cannot be run ends with a fault. Throws std::runtime_error if no process can be made.
  ChildProcess(const std::vector<std::string>& command, const std::string& log, const ProcessLimits& limits);
  /// Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// How it ended, if it has; enforces the limits. To be called every now and then.
  std::optional<ProcessEnd> poll();

  /// Asks it to end (SIGTERM), and kills it after `patience` seconds.
  void stop(double patience);

 private:
  int kill_all();
  double seconds() const;
  ProcessEnd ended(int status);

  pid_t supervisor_ = -1;
  std::string program_;
  std::string log_;
  ProcessLimits limits_;
  std::chrono::steady_clock::time_point start_;
  double peak_memory_mb_ = 0.0;
  std::string verdict_;  // why it was stopped
};

}  // namespace odosplat::apps
