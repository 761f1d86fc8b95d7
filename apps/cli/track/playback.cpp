// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/playback.hpp"

#include <algorithm>
#include <string>
#include <thread>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat::apps {
namespace {

constexpr double longest_pause = 60.0;  // [s]
constexpr double shortened_pause = 1.0;
constexpr double longest_median = 5.0;

void refuse_other_units(const Sequence& sequence, std::vector<double> gaps) {
  if (gaps.empty()) return;
  const double usual = upper_median(std::move(gaps));
  if (usual <= longest_median) return;
  const char* const unit = usual > 1e6 ? "nanoseconds" : usual > 1e3 ? "microseconds" : "milliseconds";
  throw InputError(
      sequence.name(),
      formatted("its images are %.6g s apart by their stamps: --realtime takes seconds, are they %s?", usual, unit));
}

}  // namespace

Playback::Playback(const Sequence& sequence, const FrameRange& range)
    : range_{range.begin, std::min(range.end, sequence.size())}, next_(range.begin) {
  std::vector<double> gaps;
  for (std::size_t i = range_.begin + 1; i < range_.end; ++i) gaps.push_back(sequence.time(i) - sequence.time(i - 1));
  refuse_other_units(sequence, gaps);
  after_.assign(1, 0.0);
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const std::size_t i = range_.begin + k;
    if (gaps[k] > longest_pause) {
      log_warning(sequence.name() + ": a pause of " + std::to_string(gaps[k]) + " s between frames " +
                  std::to_string(i) + " and " + std::to_string(i + 1) + " is played as 1 s");
    }
    after_.push_back(after_.back() + (gaps[k] > longest_pause ? shortened_pause : gaps[k] > 0.0 ? gaps[k] : 0.0));
  }
  start_ = Clock::now();
}

Playback::Clock::time_point Playback::due(std::size_t i) const {
  return start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(after_[i - range_.begin]));
}

std::optional<std::size_t> Playback::next(const std::function<bool()>& stopped) {
  constexpr auto nap = std::chrono::milliseconds(50);
  dropped_ = 0;
  if (next_ >= range_.end) return std::nullopt;
  for (Clock::time_point now = Clock::now(); now < due(next_); now = Clock::now()) {
    if (stopped()) return std::nullopt;
    std::this_thread::sleep_until(std::min(due(next_), now + nap));
  }
  if (stopped()) return std::nullopt;
  const Clock::time_point now = Clock::now();
  while (next_ + 1 < range_.end && due(next_ + 1) <= now) {
    ++next_;
    ++dropped_;
  }
  return next_++;
}

}  // namespace odosplat::apps
