// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {

/// A file of poses and what errors say of it.
struct NamedPoses {
  const PoseFile& file;
  std::string name;
  std::string times_flag;  // that names its times, as in "--times"
};

/// InputError if the stamps of two files do not say which of their poses belong together:
///   - both have line numbers for times, or one has and the other numbers of frames, and they do not hold equally many
///     poses (those of keyframes among them have lost their numbers);
///   - one has times and the other has none. Times that are all whole numbers count as numbers of frames.
void require_comparable_stamps(const NamedPoses& a, const NamedPoses& b);

}  // namespace odosplat
