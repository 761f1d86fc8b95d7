// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// The name that was most likely meant: fewest letters to add, drop, replace or swap with their neighbor, at most a
/// third of the word's; the first of equals. Empty where none is so near.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// "; did you mean NAME?", or nothing for an empty name.
std::string suggestion(const std::string& name);

}  // namespace odosplat::apps
