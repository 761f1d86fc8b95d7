// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace odosplat {

/// Reads a JSON object; `name` stands for the file in errors. NaN, Infinity and -Infinity, which Python writes although
/// JSON has no such numbers, are read as null. A byte-order mark of UTF-8 is passed over.
/// InputError(name, "line N, column M", fault) where the text is no JSON; InputError for another value than an object.
nlohmann::json parse_json_object(const std::string& name, const std::string& text);

}  // namespace odosplat
