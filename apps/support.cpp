// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "support.hpp"

#include <semaphore.h>
#include <sys/resource.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <new>
#include <thread>

#include "command_line.hpp"
#include "no_result.hpp"
#include "odosplat/compute/build_notice.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/compute/program.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat::apps {
namespace {

std::atomic<bool> interrupt_flag{false};
std::atomic<int> savers{0};
sem_t interrupt_came;

constexpr int exit_internal = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_no_result = 3;
constexpr int exit_interrupted = 130;

extern "C" void on_interrupt(int signal) {
  if (!interrupt_flag.exchange(true)) {
    sem_post(&interrupt_came);
  } else if (signal != SIGHUP) {  // which comes several times when a terminal closes
    std::_Exit(exit_interrupted);
  }
}

/// Ends what has not ended by itself: reading a large file or drawing a figure knows nothing of signals.
void end_when_interrupted() {
  constexpr auto patience = std::chrono::milliseconds(500);
  constexpr auto step = std::chrono::milliseconds(20);
  while (sem_wait(&interrupt_came) != 0 && errno == EINTR) {
  }
  for (auto waited = step; waited < patience; waited += step) {
    std::this_thread::sleep_for(step);
    if (savers > 0) waited = step;
  }
  std::fprintf(stderr, "odosplat: %s\n", Interrupted().what());
  std::_Exit(exit_interrupted);
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
    // Whatever was written is whole; but whoever runs a list of commands wants that to stop, too.
    if (interrupted()) throw Interrupted();
    return 0;
  } catch (const InputError& e) {
    return fail(exit_bad_input, printable_line(e.what()));
  } catch (const compute::NoSuchDevice& e) {
    return fail(exit_bad_input, printable_line(e.what()));
  } catch (const NoResult& e) {
    return fail(exit_no_result, printable_line(e.what()));
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

void catch_interrupts() {
  sem_init(&interrupt_came, 0, 0);
  std::thread(end_when_interrupted).detach();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) std::signal(SIGHUP, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit is an error of writing, told like every other
}

bool interrupted() { return interrupt_flag; }

SavesWhenInterrupted::SavesWhenInterrupted() { ++savers; }
SavesWhenInterrupted::~SavesWhenInterrupted() { --savers; }

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
