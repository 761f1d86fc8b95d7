// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdio>
#include <string>

namespace odosplat {

/// A number as messages show it: six digits at most, no zeros behind the last one ("0.5", "1e+06").
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

}  // namespace odosplat
