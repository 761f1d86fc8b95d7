// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "odosplat/io/little_endian.hpp"

namespace odosplat::apps {

/// Arrays of numbers of a page, one after the other as float32, little endian, NaN for "none".
class PageNumbers {
 public:
  /// Appends an array; its reference in the page's JSON: {"at": index of the first number, "count": numbers}.
  nlohmann::ordered_json add(const std::vector<float>& values) {
    const std::size_t at = bytes_.size() / sizeof(float);
    for (const float value : values) append_little(bytes_, value);
    return {{"at", at}, {"count", values.size()}};
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace odosplat::apps
