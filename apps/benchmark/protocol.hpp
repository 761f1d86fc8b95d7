// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/options.hpp"
#include "apps/benchmark/suite.hpp"

namespace odosplat::apps {

inline constexpr int mapping_step = 10;  // every tenth frame makes the map, as in the paper
inline constexpr int quick_frames = 200;
inline constexpr int quick_iterations = 1500;
// The paper's recipe has no limit of growth and takes hours in a room: it is cut short here, as the report's maps show.
inline constexpr int paper_iterations = 2000;
inline constexpr int paper_budget = 200000;

/// The suite's sequences that are asked for, in the suite's order. InputError for one that it does not have.
std::vector<const SuiteSequence*> chosen_sequences(const BenchmarkOptions& options, const Suite& suite);
/// The methods that are asked for; if none is, the built-in and the suite's own. InputError for one that is there twice
/// or that nobody knows.
std::vector<std::string> chosen_methods(const BenchmarkOptions& options, const Suite& suite);
/// The suite's own method of that name, or null.
const SuiteMethod* own_method(const Suite& suite, const std::string& name);

/// What maps are made of, and what a quick run cuts short (empty: nothing), for the report.
std::string mapping_in_words(const BenchmarkOptions& options, bool stand_in);
std::string quick_in_words(const BenchmarkOptions& options);

}  // namespace odosplat::apps
