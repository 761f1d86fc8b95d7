// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "support.hpp"

#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

#include "no_result.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat::apps {
namespace {

std::atomic<bool> interrupt_flag{false};

constexpr int exit_internal = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_no_result = 3;
constexpr int exit_interrupted = 130;

extern "C" void on_interrupt(int) {
  if (interrupt_flag.exchange(true)) std::_Exit(exit_interrupted);
}

int fail(int code, const char* what) {
  std::fprintf(stderr, "odosplat: %s\n", what);
  return code;
}

}  // namespace

CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& help) {
  CLI::App* command = app.add_subcommand(name, help);
  command->option_defaults()->always_capture_default();
  command->add_option(
      "--device", common.device,
      "OpenCL device: index or part of a name (default: ODOSPLAT_DEVICE, else first GPU, else first CPU)");
  command->add_option("--threads", common.threads, "CPU threads, 0 = all cores")->check(CLI::NonNegativeNumber);
  command->add_flag("--profile", common.profile, "print the device's time, stage by stage and kernel by kernel");
  command->add_option("--log", common.log, "debug, info, warning or off");
  command->set_config("--config", "", "read flags from a TOML file (flag = value)");
  command->parse_complete_callback([&common] {
    set_log_level(common.log);
    if (common.threads > 0) {
      set_threads(common.threads);
      compute::set_cpu_threads(common.threads);
    }
  });
  return command;
}

int run_program(CLI::App& app, int argc, char** argv) {
  catch_interrupts();
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(exit_bad_input, e.what());
  } catch (const InputError& e) {
    return fail(exit_bad_input, e.what());
  } catch (const compute::NoSuchDevice& e) {
    return fail(exit_bad_input, e.what());
  } catch (const NoResult& e) {
    return fail(exit_no_result, e.what());
  } catch (const Interrupted& e) {
    return fail(exit_interrupted, e.what());
  } catch (const std::exception& e) {
    return fail(exit_internal, e.what());
  }
}

compute::Context open_device(const Common& common) {
  compute::Context context = compute::Context::open(common.device);
  context.set_profiling(common.profile);
  log_info("device " + context.device().name + " (" + context.device().platform + ")");
  return context;
}

void print_profile(const Common& common, const compute::Context& context) {
  if (!common.profile) return;
  const auto print = [](const std::string& name, long launches, double milliseconds) {
    std::fprintf(stderr, "%-32s %10ld %12.1f %10.3f\n", name.c_str(), launches, milliseconds,
                 milliseconds / static_cast<double>(launches));
  };
  std::fprintf(stderr, "%-32s %10s %12s %10s\n", "stage, its kernels", "launches", "total ms", "ms each");
  for (const compute::StageTime& stage : context.stage_times()) {
    print(stage.stage, stage.launches, stage.milliseconds);
    for (const compute::KernelTime& t : stage.kernels) print("  " + t.name, t.launches, t.milliseconds);
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
  Size size;
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &end) != 2 || size.width < 1 || size.height < 1 ||
      size.width > 32768 || size.height > 32768) {
    throw InputError(flag, "must be WIDTHxHEIGHT in pixels, is " + text);
  }
  return size;
}

}  // namespace odosplat::apps
