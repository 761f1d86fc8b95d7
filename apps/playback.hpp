// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "odosplat/io/sequence.hpp"
#include "sequence_flags.hpp"

namespace odosplat::apps {

/// Hands out frames of a sequence at the rate of their stamps, as a camera would: frame i comes (time(i) - time(begin))
/// seconds after the range's first, which comes at construction. Who asks late gets the newest that has come; those
/// before it are dropped.
class Playback {
 public:
  Playback(const Sequence& sequence, const FrameRange& range);

  /// Waits for the next frame if none has come since the last call. Nothing after the last frame.
  std::optional<std::size_t> next();

  /// Frames passed over by the last call of next().
  std::size_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point due(std::size_t i) const;

  const Sequence sequence_;
  const FrameRange range_;
  const Clock::time_point start_;
  std::size_t next_;
  std::size_t dropped_ = 0;
};

}  // namespace odosplat::apps
