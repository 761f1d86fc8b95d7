// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>

#include "apps/cli/map/map_commands.hpp"

namespace odosplat::apps {

void add_map(CLI::App& app, Common& common) {
  CLI::App* map = app.add_subcommand("map", "what a map of Gaussians is; cut, merge and clean maps");
  map->require_subcommand(1);
  add_map_info(*map, common);
  add_map_crop(*map, common);
  add_map_merge(*map, common);
  add_map_clean(*map, common);
}

}  // namespace odosplat::apps
