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

/// Declares --version, all subcommands and the format of the help.
void declare_commands(CLI::App& app, Common& common);

/// Parses the words of a command line (without the program's name) and the file of --config if given, and runs the
/// command's callbacks. InputError of one line for an unknown command or flag (with the nearest name), for a value that
/// a flag refuses, and for what is missing. CLI::Success for --help and --version.
void parse_command_line(CLI::App& app, const std::vector<std::string>& words);

/// What --version prints: version, compiler and build type, and the OpenCL devices.
std::string version_text();

}  // namespace odosplat::apps
