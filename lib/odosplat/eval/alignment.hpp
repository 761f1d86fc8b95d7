// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// How an estimate is aligned with the truth before its errors are computed: not at all, by a rigid motion, or by a
/// similarity.
enum class TrajectoryAlignment { none, se3, sim3 };

/// "none", "se3", "sim3"; throws InputError for another word.
TrajectoryAlignment alignment_from_name(const std::string& name);
std::string alignment_name(TrajectoryAlignment alignment);

}  // namespace odosplat
