// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/stream_clock.hpp"

#include <algorithm>
#include <cmath>

namespace odosplat {
namespace {

constexpr double microseconds = 1e6;
constexpr double period = 10.0;        // [s]
constexpr double longest_jump = 10.0;  // [s] of stamps, beyond that of arrivals
constexpr double slew = 0.005;         // largest change of the offset per second of stamps
constexpr double least_step = 1e-3;    // [s] after a restart

}  // namespace

void StreamClock::restart() {
  settled_ = false;
  anchored_ = false;
}

double StreamClock::increasing(double time) {
  const double rounded = std::round(time * microseconds) / microseconds;
  const double next = std::round(last_time_ * microseconds + 1.0) / microseconds;
  last_time_ = std::max(rounded, next);
  return last_time_;
}

void StreamClock::follow(double delay, double arrival, double step) {
  if (!settled_) {
    offset_ = std::min(offset_, delay);
    least_ = offset_;
    previous_least_ = offset_;
    period_start_ = arrival;
    return;
  }
  if (arrival - period_start_ > period) {
    previous_least_ = least_;
    least_ = delay;
    period_start_ = arrival;
  }
  least_ = std::min(least_, delay);
  offset_ += std::clamp(std::min(least_, previous_least_) - offset_, -slew * step, slew * step);
}

double StreamClock::time_of(std::optional<double> stamp, double arrival) {
  if (!stamp) {
    anchored_ = false;
    ahead_ = 0.0;
    return increasing(arrival);
  }
  const double step = *stamp - last_stamp_;
  if (anchored_ && (step <= 0.0 || step > arrival - last_arrival_ + longest_jump)) anchored_ = false;
  const double delay = arrival - *stamp;
  if (anchored_) {
    follow(delay, arrival, step);
  } else {
    anchored_ = true;
    offset_ = std::max(arrival, last_time_ + least_step) - *stamp;
    least_ = offset_;
    previous_least_ = offset_;
    period_start_ = arrival;
  }
  last_stamp_ = *stamp;
  last_arrival_ = arrival;
  const double time = increasing(*stamp + offset_);
  ahead_ = std::max(0.0, time - arrival);
  return time;
}

}  // namespace odosplat
