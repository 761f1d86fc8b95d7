// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat::apps {

/// Makes the output of other programs printable in a report or on a terminal: valid UTF-8, with a question mark for
/// every invalid byte (such as one of Latin-1) and every control character. A text over `longest` bytes is cut at a
/// character boundary and ends with three dots.
std::string clean_text(std::string_view bytes, std::size_t longest = 200);

/// The last line of a file (of any size) that is not blank, cleaned. A line that a progress bar has overwritten counts
/// with its last visible state. Empty if there is no such line.
std::string last_line(const std::string& file);

}  // namespace odosplat::apps
