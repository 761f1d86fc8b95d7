// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// The name with the smallest edit distance (letters inserted, deleted, replaced or swapped with their neighbour) from
/// the word; the first of equals. Empty if the distance exceeds a third of the word's length (at least 1).
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// "; did you mean NAME?", or nothing for an empty name.
std::string suggestion(const std::string& name);

}  // namespace odosplat::apps
