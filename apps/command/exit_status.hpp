// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat::apps {

inline constexpr int exit_internal = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_no_result = 3;
inline constexpr int exit_interrupted = 130;

}  // namespace odosplat::apps
