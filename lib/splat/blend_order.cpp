// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/blend_order.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const std::string key = "blend_order ";

}  // namespace

std::string blend_order_line(BlendOrder order) { return key + (order == BlendOrder::distance ? "distance" : "depth"); }

BlendOrder blend_order_from_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (!line.starts_with(key)) continue;
    for (const BlendOrder order : {BlendOrder::depth, BlendOrder::distance}) {
      if (line == blend_order_line(order)) return order;
    }
    throw InputError("blend_order", "must be depth or distance, is \"" + line.substr(key.size()) + "\"");
  }
  return BlendOrder::depth;
}

}  // namespace odosplat
