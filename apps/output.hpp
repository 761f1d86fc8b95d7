// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat::apps {

/// printf to standard output for results: the one way there. Text of files and names among the arguments is shown
/// without control characters (core/terminal_text.hpp); line ends stay. InputError where it cannot be written.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

/// Writes out what waits in buffers; InputError where standard output did not take all of it (a full disk).
void finish_output();

}  // namespace odosplat::apps
