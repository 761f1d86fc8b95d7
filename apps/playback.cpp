// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "playback.hpp"

#include <algorithm>
#include <thread>

namespace odosplat::apps {

Playback::Playback(const Sequence& sequence, const FrameRange& range)
    : sequence_(sequence),
      range_{range.begin, std::min(range.end, sequence.size())},
      start_(Clock::now()),
      next_(range.begin) {}

Playback::Clock::time_point Playback::due(std::size_t i) const {
  const std::chrono::duration<double> after(sequence_.time(i) - sequence_.time(range_.begin));
  return start_ + std::chrono::duration_cast<Clock::duration>(after);
}

std::optional<std::size_t> Playback::next() {
  dropped_ = 0;
  if (next_ >= range_.end) return std::nullopt;
  std::this_thread::sleep_until(due(next_));
  const Clock::time_point now = Clock::now();
  while (next_ + 1 < range_.end && due(next_ + 1) <= now) {
    ++next_;
    ++dropped_;
  }
  return next_++;
}

}  // namespace odosplat::apps
