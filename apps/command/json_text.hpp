// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace odosplat::apps {

/// The text of a JSON file. Strings from outside, such as names of files and devices, may not be UTF-8: invalid bytes
/// are replaced by U+FFFD, where the library's default is to throw.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = 2) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace odosplat::apps
