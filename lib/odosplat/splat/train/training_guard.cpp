// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/training_guard.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

void TrainingGuard::add(int iteration, int level, double psnr_db) {
  if (iteration <= paused_until_) return;
  if (level != level_) steps_ = 0;
  level_ = level;
  if (steps_ == 0) sum_db_ = 0.0;
  sum_db_ += psnr_db;
  ++steps_;
}

void TrainingGuard::pause(int iteration) {
  paused_until_ = iteration;
  steps_ = 0;
}

TrainingGuard::Verdict TrainingGuard::judge(bool at_end) {
  if (steps_ < least_steps) return Verdict::nothing;
  last_db_ = sum_db_ / steps_;
  steps_ = 0;
  const bool first = best_level_ < 0;
  const bool same_level = best_level_ == level_;
  // Written so that a mean that is not a number counts as fallen.
  if (!first && !(last_db_ >= best_db_ - (same_level ? fall_db : 2.0 * fall_db))) {
    return ++falls_ >= patience || at_end || !std::isfinite(last_db_) ? Verdict::fallen : Verdict::nothing;
  }
  falls_ = 0;
  if (!std::isfinite(last_db_) || (same_level && last_db_ <= best_db_)) return Verdict::nothing;
  best_level_ = level_;
  best_db_ = last_db_;
  return Verdict::best;
}

std::vector<double> TrainingGuard::state() const {
  return {static_cast<double>(level_),
          static_cast<double>(steps_),
          sum_db_,
          static_cast<double>(best_level_),
          best_db_,
          last_db_,
          static_cast<double>(paused_until_),
          static_cast<double>(falls_)};
}

void TrainingGuard::set_state(const std::vector<double>& state) {
  const auto whole = [&](std::size_t i, double least) {
    return state[i] >= least && state[i] <= std::numeric_limits<int>::max() && state[i] == std::floor(state[i]);
  };
  // Means may be no numbers: a run that collapsed can have such.
  require(state.size() == 8 && whole(0, 0.0) && whole(1, 0.0) && whole(3, -1.0) && std::isfinite(state[4]) &&
              whole(6, 0.0) && whole(7, 0.0),
          "guard", "the state of a guard");
  level_ = static_cast<int>(state[0]);
  steps_ = static_cast<int>(state[1]);
  sum_db_ = state[2];
  best_level_ = static_cast<int>(state[3]);
  best_db_ = state[4];
  last_db_ = state[5];
  paused_until_ = static_cast<int>(state[6]);
  falls_ = static_cast<int>(state[7]);
}

}  // namespace odosplat
