// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {

/// A file of poses and how error messages refer to it.
struct NamedPoses {
  const PoseFile& file;
  std::string name;
  std::string times_flag;  // the flag that gives its times, as in "--times"
};

/// Throws InputError if the stamps of two files do not determine which of their poses correspond:
///   - at least one has line numbers instead of times, and the files do not have the same number of poses (for example
///     if one has poses of keyframes only, whose frame numbers are not stored);
///   - one has times and the other has none. Times that are all whole numbers count as frame numbers.
void require_comparable_stamps(const NamedPoses& a, const NamedPoses& b);

}  // namespace odosplat
