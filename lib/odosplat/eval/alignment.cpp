// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/alignment.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {

TrajectoryAlignment alignment_from_name(const std::string& name) {
  for (const TrajectoryAlignment a : {TrajectoryAlignment::none, TrajectoryAlignment::se3, TrajectoryAlignment::sim3}) {
    if (name == alignment_name(a)) return a;
  }
  throw InputError("align", "must be none, se3 or sim3, is \"" + name + "\"");
}

std::string alignment_name(TrajectoryAlignment alignment) {
  if (alignment == TrajectoryAlignment::none) return "none";
  return alignment == TrajectoryAlignment::se3 ? "se3" : "sim3";
}

}  // namespace odosplat
