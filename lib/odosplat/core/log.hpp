// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Messages for the person who runs a program, on standard error; results go to standard output. A message may contain
/// text from files: it is shown as one line without control characters (terminal_text.hpp). Thread safe.
void log_debug(const std::string& message);
void log_info(const std::string& message);
void log_warning(const std::string& message);
/// Whether log_info shows anything at the current level. Progress (progress.hpp) is shown under the same condition.
bool logs_info();
/// debug | info | warning | off; throws InputError for another word. Default: info.
void set_log_level(const std::string& level);

}  // namespace odosplat
