// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// How an estimate is laid over the truth before it is judged: as it is, by a rigid motion, or with a scale as well.
enum class TrajectoryAlignment { none, se3, sim3 };

/// "none", "se3", "sim3"; throws InputError for another word.
TrajectoryAlignment alignment_from_name(const std::string& name);
std::string alignment_name(TrajectoryAlignment alignment);

}  // namespace odosplat
