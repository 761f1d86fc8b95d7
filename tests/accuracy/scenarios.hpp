// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "apps/command/commands.hpp"

namespace CLI {
class App;
}  // namespace CLI

/// The scenarios, one file each. Every add_X declares its command on `app`, which runs the scenario if it was chosen.
namespace odosplat::accuracy {

void add_plain(CLI::App& app, apps::Common& common);
void add_long_path(CLI::App& app, apps::Common& common);
void add_leave_map(CLI::App& app, apps::Common& common);
void add_kidnap(CLI::App& app, apps::Common& common);
void add_confirm(CLI::App& app, apps::Common& common);
void add_deceive(CLI::App& app, apps::Common& common);
void add_disturb(CLI::App& app, apps::Common& common);
void add_ablate(CLI::App& app, apps::Common& common);

}  // namespace odosplat::accuracy
