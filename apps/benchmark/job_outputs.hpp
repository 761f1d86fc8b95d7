// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "apps/benchmark/job.hpp"

namespace odosplat::apps {

/// Of text that jobs leave behind: more is no trajectory and no report.
inline constexpr std::size_t most_result_bytes = std::size_t{256} << 20U;

/// What is wrong with the files of a job that has run, in words that name the file: an output that is missing or no
/// regular file, text (*.txt, *.json) that is too large, a *.json that is cut or no JSON object. Empty: nothing. Files
/// that it need not write (Job::reports) may be missing.
std::string output_fault(const Job& job);

}  // namespace odosplat::apps
