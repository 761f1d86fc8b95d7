// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/eval/statistics.hpp"

namespace odosplat {
namespace {

void check_ascending(const Trajectory& trajectory, const char* name) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const bool finite = std::isfinite(trajectory[i].time);
    if (!finite || (i > 0 && trajectory[i].time < trajectory[i - 1].time)) {
      throw InputError(name, "pose " + std::to_string(i), finite ? "is earlier than the one before" : "has no time");
    }
  }
}

std::size_t nearest_in_time(const Trajectory& trajectory, double time) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.time < t; });
  if (after == trajectory.begin()) return 0;
  const auto before = after - 1;
  const bool later = after != trajectory.end() && std::abs(after->time - time) < std::abs(before->time - time);
  return static_cast<std::size_t>((later ? after : before) - trajectory.begin());
}

}  // namespace

std::vector<Match> associate(const Trajectory& estimate, const Trajectory& truth, double max_time_difference) {
  require(std::isfinite(max_time_difference) && max_time_difference >= 0.0, "max_time_difference", "at least 0 [s]");
  check_ascending(estimate, "estimate");
  check_ascending(truth, "truth");
  if (estimate.empty() || truth.empty()) return {};
  const bool estimate_is_long = estimate.size() > truth.size();
  const Trajectory& shorter = estimate_is_long ? truth : estimate;
  const Trajectory& longer = estimate_is_long ? estimate : truth;

  constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> owner(longer.size(), nobody);
  const auto distance = [&](std::size_t s, std::size_t l) { return std::abs(longer[l].time - shorter[s].time); };
  for (std::size_t s = 0; s < shorter.size(); ++s) {
    const std::size_t l = nearest_in_time(longer, shorter[s].time);
    if (distance(s, l) > max_time_difference) continue;
    if (owner[l] == nobody || distance(s, l) < distance(owner[l], l)) owner[l] = s;
  }
  std::vector<Match> matches;
  for (std::size_t l = 0; l < longer.size(); ++l) {
    if (owner[l] == nobody) continue;
    matches.push_back(estimate_is_long ? Match{l, owner[l]} : Match{owner[l], l});
  }
  return matches;
}

std::size_t expected_frames(const Trajectory& estimate, const Trajectory& truth) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < estimate.size(); ++i) steps.push_back(estimate[i].time - estimate[i - 1].time);
  std::sort(steps.begin(), steps.end());
  const double step = percentile(steps, 10.0);
  if (steps.empty() || step <= 0.0) return truth.size();
  double frames = truth.empty() ? 0.0 : 1.0;
  for (std::size_t i = 1; i < truth.size(); ++i) frames += std::min(1.0, (truth[i].time - truth[i - 1].time) / step);
  return static_cast<std::size_t>(std::lround(frames));
}

}  // namespace odosplat
