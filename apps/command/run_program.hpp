// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// What main() does: has the commands declared, parses the command line, runs the chosen command, prints an
/// error as one line on standard error, and returns the exit status:
///     0  done
///     1  internal failure
///     2  bad usage or input, also standard output that cannot be written
///     3  no result (NoResult)
///   130  interrupted
int run_program(const std::function<void(CLI::App&)>& declare, int argc, char** argv) noexcept;

}  // namespace odosplat::apps
