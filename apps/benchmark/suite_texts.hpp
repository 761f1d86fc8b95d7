// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string_view>

namespace odosplat::apps {

/// Text of a built-in suite (data/suites/NAME.yaml at build time); empty if there is none of that name.
std::string_view suite_text(std::string_view name);

}  // namespace odosplat::apps
