// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// What main() does once the commands are declared: parses, runs the chosen one, and turns errors into one line on
/// standard error and the exit status: 0 done, 1 internal failure, 2 bad usage or input (standard output that cannot be
/// written is that too), 3 no result (NoResult), 130 interrupted.
int run_program(CLI::App& app, int argc, char** argv);

}  // namespace odosplat::apps
