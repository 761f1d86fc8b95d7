// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/formatted.hpp"

#include <cstddef>
#include <cstdio>

namespace odosplat {

std::string formatted(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::string text = formatted_list(format, arguments);
  va_end(arguments);
  return text;
}

std::string formatted_list(const char* format, std::va_list arguments) {
  // A list can be gone through only once: measuring takes a copy.
  std::va_list measured;
  va_copy(measured, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, measured);
  va_end(measured);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  // vsnprintf() writes its terminating zero to the position where std::string has its own.
  std::vsnprintf(text.data(), text.size() + 1, format, arguments);
  return text;
}

std::string number_text(double value) { return formatted("%.6g", value); }

}  // namespace odosplat
