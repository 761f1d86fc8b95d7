// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/command_line.hpp"

#include <CLI/CLI.hpp>

#include "apps/command/run_program.hpp"
#include "apps/command/support.hpp"

int main(int argc, char** argv) {
  odosplat::apps::Common common;
  return odosplat::apps::run_program([&](CLI::App& app) { odosplat::apps::declare_commands(app, common); }, argc, argv);
}
