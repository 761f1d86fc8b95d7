// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat::apps {

/// What other programs wrote, made fit for a line of a report or a terminal: UTF-8, in which every byte that is not
/// (such as one of Latin-1) and every control character is a question mark. Of a text over `longest` bytes the start is
/// kept, up to a whole character, and three dots.
std::string clean_text(std::string_view bytes, std::size_t longest = 200);

/// The last line with words in it, cleaned, of a file of any size; of a line that a progress bar overwrote, what was
/// left to see. Empty if there is none.
std::string last_line(const std::string& file);

}  // namespace odosplat::apps
