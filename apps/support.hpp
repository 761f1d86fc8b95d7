// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <string>

#include "commands.hpp"
#include "odosplat/compute/context.hpp"
#include "output.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// Declares a subcommand with the common flags; the common flags are applied before `run` is called.
CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& help);

/// What main() does once the commands are declared: parses, runs the chosen one, and turns errors into one line on
/// standard error and the exit status: 0 done, 1 internal failure, 2 bad usage or input (standard output that cannot be
/// written is that too), 130 interrupted.
int run_program(CLI::App& app, int argc, char** argv);

/// Opens the device that was asked for and says which one it is on the log.
compute::Context open_device(const Common& common);

/// With --profile: time of every stage and its kernels since the context was opened, on standard error.
void print_profile(const Common& common, const compute::Context& context);

/// Ctrl-C, SIGTERM and the end of the terminal (SIGHUP, unless it is ignored as under nohup) set a flag; long loops ask
/// it. Outputs appear whole or not at all, so whatever has not ended 0.5 s later is ended here, with status 130, unless
/// a SavesWhenInterrupted lives. A second Ctrl-C or SIGTERM ends the process at once.
void catch_interrupts();
bool interrupted();

/// Lives while a command asks interrupted() often and then writes what it has so far.
class SavesWhenInterrupted {
 public:
  SavesWhenInterrupted();
  ~SavesWhenInterrupted();
  SavesWhenInterrupted(const SavesWhenInterrupted&) = delete;
  SavesWhenInterrupted& operator=(const SavesWhenInterrupted&) = delete;
};

/// Largest resident size of this process so far [MB].
double peak_memory_mb();

/// [s] that all threads of this process have run so far.
double cpu_seconds();

/// "640x480" to width and height in 1..32768; InputError("FLAG", ...) otherwise.
struct Size {
  int width = 0;
  int height = 0;
};
Size parse_size(const std::string& flag, const std::string& text);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace odosplat::apps
