// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// The rest of main() after the commands are declared: parses the command line, runs the chosen command, prints an
/// error as one line on standard error, and returns the exit status:
///     0  done
///     1  internal failure
///     2  bad usage or input, also standard output that cannot be written
///     3  no result (NoResult)
///   130  interrupted
int run_program(CLI::App& app, int argc, char** argv);

}  // namespace odosplat::apps
