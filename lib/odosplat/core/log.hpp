// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Lines for the person who runs a program, on standard error; results go to standard output. A message may hold text
/// of files: it is shown as one line without control characters (terminal_text.hpp). Thread safe.
void log_debug(const std::string& message);
void log_info(const std::string& message);
void log_warning(const std::string& message);
/// Whether log_info shows anything at the level that is set; progress is shown where it does.
bool logs_info();
/// debug | info | warning | off; throws InputError for another word. Default: info.
void set_log_level(const std::string& level);

}  // namespace odosplat
