// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace odosplat::apps {

/// The text of a JSON file. Words from outside, such as names of files and devices, need not be UTF-8: what is not is
/// replaced by U+FFFD, where the library's own default throws.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = 2) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace odosplat::apps
