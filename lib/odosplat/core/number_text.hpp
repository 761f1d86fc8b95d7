// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdio>
#include <string>

namespace odosplat {

/// A number for messages: at most six significant digits, no trailing zeros ("0.5", "1e+06").
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

}  // namespace odosplat
