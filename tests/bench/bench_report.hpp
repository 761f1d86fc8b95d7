// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat {

/// Runs the registered benchmarks with Google Benchmark's flags, and reports them under the names they were registered
/// with: the library would append what kind of time was measured. Throws InputError for flags it does not know.
void run_benchmarks(int argc, char** argv);

}  // namespace odosplat
