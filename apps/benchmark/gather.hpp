// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "apps/benchmark/plan.hpp"
#include "apps/benchmark/report/results.hpp"

namespace odosplat::apps {

/// Reads what the jobs of a plan left and judges every run by the sequence's truth. Jobs that failed or were not run
/// are in it with their fault. Nothing is run; the same files give the same results.
BenchmarkResults gather(const Plan& plan);

}  // namespace odosplat::apps
