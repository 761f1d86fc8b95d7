// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <string>

namespace odosplat {

/// Wall time spent in one stage of the odometry.
struct StageTime {
  std::string name{};
  double milliseconds = 0.0;
};

using SteadyClock = std::chrono::steady_clock;

inline double milliseconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
}

/// Adds the time of a scope to a stage.
class StageTimer {
 public:
  explicit StageTimer(StageTime& stage) : stage_(stage), start_(SteadyClock::now()) {}
  ~StageTimer() { stage_.milliseconds += milliseconds_since(start_); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  StageTime& stage_;
  SteadyClock::time_point start_;
};

}  // namespace odosplat
