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

/// Hands out frames of a sequence at the rate of their stamps, as a camera would: frame i comes (time(i) - time(begin))
/// seconds after the range's first, which comes at construction. Who asks late gets the newest that has come; those
/// before it are dropped. A pause of over 60 s between two stamps is played as 1 s, and named on the log: it is a fault
/// of the stamps, or nobody wants to wait for it.
class Playback {
 public:
  /// InputError if the stamps are further apart than any camera's (median over 5 s), as stamps in milliseconds are.
  Playback(const Sequence& sequence, const FrameRange& range);

  /// Waits for the next frame if none has come since the last call. Nothing after the last frame, or as soon as
  /// `stopped` says so.
  std::optional<std::size_t> next(const std::function<bool()>& stopped);

  /// Frames passed over by the last call of next().
  std::size_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point due(std::size_t i) const;

  const FrameRange range_;
  std::vector<double> after_;  // of each frame of the range: seconds after the first
  Clock::time_point start_;
  std::size_t next_;
  std::size_t dropped_ = 0;
};

}  // namespace odosplat::apps
