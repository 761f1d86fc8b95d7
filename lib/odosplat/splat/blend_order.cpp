// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/blend_order.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const std::string key = "blend_order ";

std::string word_of(BlendOrder order) { return order == BlendOrder::distance ? "distance" : "depth"; }

}  // namespace

BlendOrder blend_order(const std::string& word) {
  for (const BlendOrder order : {BlendOrder::depth, BlendOrder::distance}) {
    if (word == word_of(order)) return order;
  }
  throw InputError("blend_order", "must be depth or distance, is \"" + word + "\"");
}

std::string blend_order_line(BlendOrder order) { return key + word_of(order); }

BlendOrder blend_order_from_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (line.starts_with(key)) return blend_order(line.substr(key.size()));
  }
  return BlendOrder::depth;
}

}  // namespace odosplat
