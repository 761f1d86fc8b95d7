// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/comparable_stamps.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

bool are_whole(const Trajectory& poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [](const StampedPose& pose) { return pose.time == std::floor(pose.time); });
}

StampKind kind_of(const PoseFile& file) {
  return file.stamps == StampKind::times && are_whole(file.poses) ? StampKind::frame_numbers : file.stamps;
}

std::string count(const NamedPoses& poses) { return std::to_string(poses.file.poses.size()) + " poses"; }

void require_times_of_both(const NamedPoses& timed, const NamedPoses& other) {
  if (timed.file.stamps != StampKind::times || other.file.stamps == StampKind::times) return;
  if (other.file.stamps == StampKind::frame_numbers && kind_of(timed.file) == StampKind::frame_numbers) return;
  throw InputError(other.name, "has no times, " + timed.name + " has: name its times (" + other.times_flag + ")");
}

}  // namespace

void require_comparable_stamps(const NamedPoses& a, const NamedPoses& b) {
  require_times_of_both(a, b);
  require_times_of_both(b, a);
  const bool by_line = a.file.stamps == StampKind::line_numbers || b.file.stamps == StampKind::line_numbers;
  if (!by_line || a.file.poses.size() == b.file.poses.size()) return;
  throw InputError(a.name, "holds " + count(a) + " without times, " + b.name + " " + count(b) +
                               ": which of them belong together is not known; name the times of both (" + a.times_flag +
                               ", " + b.times_flag + ")");
}

}  // namespace odosplat
