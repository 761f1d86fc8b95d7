// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/run_program.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>

#include "apps/command/command_line.hpp"
#include "apps/command/exit_status.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/output.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat::apps {
namespace {

int fail(int code, const std::string& what) {
  std::fprintf(stderr, "odosplat: %s\n", what.c_str());
  return code;
}

int run(const std::function<void(CLI::App&)>& declare, int argc, char** argv) {
  catch_interrupts();
  try {
    CLI::App app;
    declare(app);
    if (app.get_name().empty()) app.name(std::filesystem::path(argv[0]).filename().string());
    try {
      parse_command_line(app, {argv + std::min(argc, 1), argv + argc});
    } catch (const CLI::Success& e) {  // --help, --version
      app.exit(e);
    }
    finish_output();
    // The command's output is complete, but the status must tell a script that runs several commands to stop.
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
    return fail(exit_internal, printable_text(e.what()));  // keeps line ends, for example of a compiler's log
  }
}

}  // namespace

int run_program(const std::function<void(CLI::App&)>& declare, int argc, char** argv) noexcept {
  try {
    return run(declare, argc, argv);
  } catch (...) {  // no memory for the message either
    std::fputs("odosplat: there is too little memory\n", stderr);
    return exit_internal;
  }
}

}  // namespace odosplat::apps
