// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "apps/command/commands.hpp"

/// The subcommands of `odosplat map`, one file each.
namespace odosplat::apps {

void add_map_info(CLI::App& map, Common& common);
void add_map_crop(CLI::App& map, Common& common);
void add_map_merge(CLI::App& map, Common& common);
void add_map_clean(CLI::App& map, Common& common);

}  // namespace odosplat::apps
