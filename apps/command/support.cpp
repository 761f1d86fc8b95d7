// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/support.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <ctime>

#include "odosplat/compute/build_notice.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/compute/program.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat::apps {
compute::Context open_device(const Common& common) {
  compute::Context context = compute::Context::open(common.device);
  context.set_profiling(common.profile);
  compute::set_build_notice(
      context, [] { log_info("building OpenCL kernels, once per device and version: the next start is quick"); });
  log_info("device " + context.device().name + " (" + context.device().platform + ")");
  if (const std::string fault = compute::program_cache_fault(); !fault.empty()) log_warning(fault);
  return context;
}

void print_profile(const Common& common, const compute::Context& context) {
  if (!common.profile) return;
  const auto print_time = [](const std::string& name, long launches, double milliseconds) {
    std::fprintf(stderr, "%-32s %10ld %12.1f %10.3f\n", name.c_str(), launches, milliseconds,
                 milliseconds / static_cast<double>(launches));
  };
  std::fprintf(stderr, "%-32s %10s %12s %10s\n", "stage, its kernels", "launches", "total ms", "ms each");
  for (const compute::StageTime& stage : context.stage_times()) {
    print_time(stage.stage, stage.launches, stage.milliseconds);
    for (const compute::KernelTime& t : stage.kernels) print_time("  " + t.name, t.launches, t.milliseconds);
  }
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Size parse_size(const std::string& flag, const std::string& text) {
  constexpr int most = 32768;
  Size size;
  const char* end = text.data() + text.size();
  const auto [x, width_error] = std::from_chars(text.data(), end, size.width);
  const bool is_pair = width_error == std::errc() && x != end && *x == 'x';
  const auto [rest, height_error] = std::from_chars(is_pair ? x + 1 : end, end, size.height);
  if (!is_pair || height_error != std::errc() || rest != end || std::min(size.width, size.height) < 1 ||
      std::max(size.width, size.height) > most) {
    throw InputError(flag, "must be WIDTHxHEIGHT in pixels, 1x1 to 32768x32768, is " + text);
  }
  return size;
}

}  // namespace odosplat::apps
