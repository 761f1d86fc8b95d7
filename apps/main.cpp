// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "support.hpp"

using namespace odosplat;

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
  apps::add_map(app, common);
  apps::add_render(app, common);
  apps::add_track(app, common);
  apps::add_relocalise(app, common);
  apps::add_eval(app, common);
  apps::add_eval_depth(app, common);
  apps::add_view(app, common);
  apps::add_benchmark(app, common);
  apps::add_synthesize(app, common);
  apps::add_demo(app, common);
  return apps::run_program(app, argc, argv);
}
