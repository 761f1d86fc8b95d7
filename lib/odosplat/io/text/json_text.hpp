// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace odosplat {

/// Parses a JSON object; `name` stands for the file in errors. NaN, Infinity and -Infinity, which Python writes
/// although JSON has no such numbers, are read as null. A UTF-8 byte-order mark is skipped.
/// Throws InputError(name, "line N, column M", fault) if the text is not JSON, and InputError if it is not an object.
nlohmann::json parse_json_object(const std::string& name, const std::string& text);

}  // namespace odosplat
