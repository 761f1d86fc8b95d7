// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdarg>
#include <string>

namespace odosplat {

/// printf into a string of any length: nothing is cut off.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// The same for functions that are variadic themselves: the caller starts and ends the list, which is used up.
[[gnu::format(printf, 1, 0)]] std::string formatted_list(const char* format, std::va_list arguments);

/// A number for messages: at most six significant digits, no trailing zeros ("0.5", "1e+06").
std::string number_text(double value);

}  // namespace odosplat
