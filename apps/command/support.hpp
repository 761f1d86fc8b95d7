// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <string>

#include "apps/command/commands.hpp"
#include "odosplat/compute/context.hpp"

namespace odosplat::apps {

/// Opens the selected device and logs its name.
compute::Context open_device(const Common& common);

/// With --profile: prints the time of every stage and its kernels since the context was opened on standard error.
void print_profile(const Common& common, const compute::Context& context);

/// Largest resident size of this process so far [MB].
double peak_memory_mb();

/// CPU time of all threads of this process so far [s].
double cpu_seconds();

/// "640x480" to width and height in 1..32768; InputError("FLAG", ...) otherwise.
struct Size {
  int width = 0;
  int height = 0;
};
Size parse_size(const std::string& flag, const std::string& text);

/// Measures seconds since its construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace odosplat::apps
