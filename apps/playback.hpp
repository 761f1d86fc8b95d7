// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "odosplat/io/sequence.hpp"

namespace odosplat::apps {

/// Hands out a sequence's frames at the rate of their stamps, as a camera would: frame i comes (time(i) - time(0))
/// seconds after frame 0, which comes at construction. Who asks late gets the newest that has come; those before it are
/// dropped.
class Playback {
 public:
  explicit Playback(const Sequence& sequence);

  /// Waits for the next frame if none has come since the last call. Nothing after the last frame.
  std::optional<std::size_t> next();

  /// Frames passed over by the last call of next().
  std::size_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point due(std::size_t i) const;

  const Sequence sequence_;
  const Clock::time_point start_;
  std::size_t next_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace odosplat::apps
