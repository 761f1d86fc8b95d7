// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/options.hpp"
#include "apps/benchmark/suite.hpp"

namespace odosplat::apps {

inline constexpr int mapping_step = 10;  // every tenth frame is a mapping frame, as in the paper
inline constexpr int quick_frames = 200;
inline constexpr int quick_iterations = 1500;
// The paper's recipe has no limit on the number of Gaussians and takes hours for a room. It is shortened here, which
// the report's table of maps shows.
inline constexpr int paper_iterations = 2000;
inline constexpr int paper_budget = 200000;

/// The selected sequences (all if none is named), in the suite's order. InputError for a name that the suite lacks.
std::vector<const SuiteSequence*> chosen_sequences(const BenchmarkOptions& options, const Suite& suite);
/// The selected methods; if none is named, the built-in ones and the suite's own. InputError for a name given twice or
/// unknown.
std::vector<std::string> chosen_methods(const BenchmarkOptions& options, const Suite& suite);
/// The suite's own method of that name; null if there is none.
const SuiteMethod* own_method(const Suite& suite, const std::string& name);

/// For the report: which frames and clouds maps are made of, and what --quick shortens (empty: nothing).
std::string mapping_in_words(const BenchmarkOptions& options, bool stand_in);
std::string quick_in_words(const BenchmarkOptions& options);

}  // namespace odosplat::apps
