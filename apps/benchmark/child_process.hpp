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
  double memory_mb = 8192.0;  // resident, sum over the process and its descendants
};

struct ProcessEnd {
  std::string fault;  // one line; empty: it ended with status 0
  double seconds = 0.0;
  double peak_memory_mb = 0.0;  // largest resident size seen
};

/// A child process in a process group of its own (the terminal's Ctrl-C does not reach it), with its output in a file.
/// It is stopped when it exceeds its limits. When it ends, or when this process ends in whatever way, all its
/// descendants are killed, also those in sessions of their own. Linux only. Not thread safe.
class ChildProcess {
 public:
  /// command: program (looked up in PATH unless it contains a slash) and arguments. log: replaced if it exists; its
  /// folder must exist. A program that cannot be run ends with a fault. Throws std::runtime_error if no process can be
  /// created.
  ChildProcess(const std::vector<std::string>& command, const std::string& log, const ProcessLimits& limits);
  /// Kills the process if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Enforces the limits and returns how the process ended; nothing while it runs. To be called periodically.
  std::optional<ProcessEnd> poll();

  /// Sends SIGTERM to the process and its descendants; kills them if they still run after `patience` seconds.
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
