// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "support.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <new>

#include "command_line.hpp"
#include "odosplat/compute/build_notice.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat::apps {
namespace {

std::atomic<bool> interrupt_flag{false};

constexpr int exit_internal = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_interrupted = 130;

extern "C" void on_interrupt(int) {
  if (interrupt_flag.exchange(true)) std::_Exit(exit_interrupted);
}

int fail(int code, const std::string& what) {
  std::fprintf(stderr, "odosplat: %s\n", what.c_str());
  return code;
}

}  // namespace

int run_program(CLI::App& app, int argc, char** argv) {
  catch_interrupts();
  if (app.get_name().empty()) app.name(std::filesystem::path(argv[0]).filename().string());
  try {
    try {
      parse_command_line(app, {argv + std::min(argc, 1), argv + argc});
    } catch (const CLI::Success& e) {  // --help, --version
      app.exit(e);
    }
    finish_output();
    return 0;
  } catch (const InputError& e) {
    return fail(exit_bad_input, printable_line(e.what()));
  } catch (const compute::NoSuchDevice& e) {
    return fail(exit_bad_input, printable_line(e.what()));
  } catch (const Interrupted& e) {
    return fail(exit_interrupted, printable_line(e.what()));
  } catch (const std::bad_alloc&) {
    return fail(exit_internal, "there is too little memory");
  } catch (const std::exception& e) {
    return fail(exit_internal, printable_text(e.what()));  // a compiler's log has lines
  }
}

compute::Context open_device(const Common& common) {
  compute::Context context = compute::Context::open(common.device);
  context.set_profiling(common.profile);
  compute::set_build_notice(
      context, [] { log_info("building OpenCL kernels, once per device and version: the next start is quick"); });
  log_info("device " + context.device().name + " (" + context.device().platform + ")");
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

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

bool interrupted() { return interrupt_flag; }

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
