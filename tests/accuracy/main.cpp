// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Accuracy of the odometry under difficult conditions: runs on sequences with true poses, which are used for
// evaluation; of the truth the odometry gets only the first pose.
#include <CLI/CLI.hpp>

#include "apps/command/run_program.hpp"
#include "apps/command/support.hpp"
#include "tests/accuracy/scenarios.hpp"

using namespace odosplat;

namespace {

void declare(CLI::App& app, apps::Common& common) {
  app.description("odosplat_accuracy: runs of the odometry under hard conditions, judged by true poses");
  app.require_subcommand(1);
  accuracy::add_plain(app, common);
  accuracy::add_long_path(app, common);
  accuracy::add_leave_map(app, common);
  accuracy::add_kidnap(app, common);
  accuracy::add_confirm(app, common);
  accuracy::add_deceive(app, common);
  accuracy::add_disturb(app, common);
  accuracy::add_ablate(app, common);
}

}  // namespace

int main(int argc, char** argv) {
  apps::Common common;
  return apps::run_program([&](CLI::App& app) { declare(app, common); }, argc, argv);
}
