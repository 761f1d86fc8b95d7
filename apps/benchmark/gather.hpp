// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "apps/benchmark/plan.hpp"
#include "apps/benchmark/report/results.hpp"

namespace odosplat::apps {

/// Reads the output of a plan's jobs and evaluates every run against the sequence's true poses. Jobs that failed or
/// were not run are included with their fault. Nothing is run; the same files give the same results.
BenchmarkResults gather(const Plan& plan);

}  // namespace odosplat::apps
