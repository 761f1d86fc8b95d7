// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <optional>

namespace odosplat {

/// Maps the presentation stamps of a live stream onto the clock by which its images arrive:
///   time = stamp + offset
/// where the offset is the least (arrival - stamp) seen, that of the image with the least delay. Until settle(), the
/// offset follows that minimum at once. From then on the intervals between times are those of the stamps to 0.5 %: the
/// offset moves by no more than that towards the minimum of the last 10 to 20 s, which corrects for a clock of the
/// camera that runs faster or slower. Without a stamp, time = arrival. Where stamps go back or jump by over 10 s more
/// than the arrivals do, the mapping starts anew at the image's arrival. Times are multiples of 1 us and always
/// increase. Not thread safe.
class StreamClock {
 public:
  /// stamp: of the stream [s]; none: it has none. arrival [s], must not decrease.
  double time_of(std::optional<double> stamp, double arrival);
  void settle() { settled_ = true; }
  /// The stamps to come do not belong to those before (another connection).
  void restart();
  /// [s] How much earlier the last image arrived than its time says; 0: later, as it should. Grows if images come
  /// faster than their stamps say.
  double ahead() const { return ahead_; }

 private:
  static constexpr double none = std::numeric_limits<double>::infinity();

  void follow(double delay, double arrival, double step);
  double increasing(double time);

  bool settled_ = false;
  bool anchored_ = false;
  double offset_ = 0.0;
  double last_stamp_ = 0.0;
  double last_arrival_ = 0.0;
  double last_time_ = -none;
  double ahead_ = 0.0;
  // Least delay (arrival - stamp) in the present and in the previous period of 10 s.
  double period_start_ = 0.0;
  double least_ = none;
  double previous_least_ = none;
};

}  // namespace odosplat
