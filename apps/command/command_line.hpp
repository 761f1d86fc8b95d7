// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/command/commands.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// Declares --version, every subcommand and how help looks.
void declare_commands(CLI::App& app, Common& common);

/// Reads the words of a command line (without the program's name), and --config if it is among them, and runs the
/// command's callbacks. InputError of one line for a command or flag that does not exist (with the nearest one), for
/// what a flag refuses, and for what is missing; CLI::Success for --help and --version.
void parse_command_line(CLI::App& app, const std::vector<std::string>& words);

/// What --version prints: version, compiler and build type, and the OpenCL devices.
std::string version_text();

}  // namespace odosplat::apps
