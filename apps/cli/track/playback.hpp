// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Plays the frames of a sequence at the rate of their time stamps, like a live camera: the first frame of the range is
/// due at construction, frame i (time(i) - time(begin)) seconds later. A caller that is late gets the newest frame that
/// is due; older ones are dropped. A pause of over 60 s between two stamps is played as 1 s with a warning, because it
/// is either an error in the stamps or too long to wait for.
class Playback {
 public:
  /// InputError if the stamps are too far apart for any camera (median over 5 s): they are probably not in seconds.
  Playback(const Sequence& sequence, const FrameRange& range);

  /// Waits until the next frame is due and returns it. Nothing after the last frame, or if `stopped` returns true.
  std::optional<std::size_t> next(const std::function<bool()>& stopped);

  /// Number of frames dropped by the last call of next().
  std::size_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point due(std::size_t i) const;

  const FrameRange range_;
  std::vector<double> after_;  // for each frame of the range: seconds after the first
  Clock::time_point start_;
  std::size_t next_;
  std::size_t dropped_ = 0;
};

}  // namespace odosplat::apps
