// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "apps/benchmark/job.hpp"

namespace odosplat::apps {

/// Limit for text files that jobs write: a larger file is neither a trajectory nor a report.
inline constexpr std::size_t most_result_bytes = std::size_t{256} << 20U;

/// Checks the output files of a job that has run. Returns a message that names the file: a missing output or one that
/// is no regular file, a text file (*.txt, *.json) over the size limit, a *.json that is truncated or no JSON object.
/// Empty: no fault. Optional files (Job::reports) may be missing.
std::string output_fault(const Job& job);

}  // namespace odosplat::apps
