// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat {

/// Runs the registered benchmarks with Google Benchmark's flags, and reports them under their registered names, without
/// the kind of time that the library appends. Throws InputError for unknown flags.
void run_benchmarks(int argc, char** argv);

}  // namespace odosplat
