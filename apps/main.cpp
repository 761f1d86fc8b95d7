// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "support.hpp"

using namespace odosplat;

namespace {

constexpr int exit_internal = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_interrupted = 130;

int fail(int code, const char* what) {
  std::fprintf(stderr, "odosplat: %s\n", what);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"odosplat: localise a camera in a map of 3-D Gaussians"};
  app.set_version_flag("--version", ODOSPLAT_VERSION);
  app.require_subcommand(1);
  apps::Common common;
  apps::add_devices(app, common);
  apps::add_check(app, common);
  apps::add_cloud(app, common);
  apps::add_align(app, common);
  apps::add_convert(app, common);
  apps::add_train(app, common);
  apps::add_render(app, common);
  apps::add_track(app, common);
  apps::add_relocalise(app, common);
  apps::add_eval(app, common);
  apps::add_eval_depth(app, common);
  apps::add_view(app, common);
  apps::add_demo(app, common);
  apps::catch_interrupts();
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
  } catch (const Interrupted& e) {
    return fail(exit_interrupted, e.what());
  } catch (const std::exception& e) {
    return fail(exit_internal, e.what());
  }
}
