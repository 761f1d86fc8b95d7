// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Lines for the person who runs a program, on standard error; results go to standard output. Thread safe.
void log_debug(const std::string& message);
void log_info(const std::string& message);
void log_warning(const std::string& message);
/// debug | info | warning | off; throws InputError for another word. Default: info.
void set_log_level(const std::string& level);

}  // namespace odosplat
