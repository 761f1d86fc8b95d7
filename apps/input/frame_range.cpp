// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/frame_range.hpp"

#include <algorithm>
#include <charconv>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat::apps {

FrameRange parse_frames(const std::string& text) {
  const InputError wrong("--frames", "must be A:B with A < B, is " + text);
  const auto colon = text.find(':');
  if (colon == std::string::npos) throw wrong;
  const auto number = [&](const std::string& word, std::size_t missing) {
    std::size_t value = missing;
    const char* end = word.data() + word.size();
    if (word.empty()) return value;
    const auto [rest, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || rest != end) throw wrong;
    return value;
  };
  FrameRange range;
  range.begin = number(text.substr(0, colon), range.begin);
  range.end = number(text.substr(colon + 1), range.end);
  if (range.begin >= range.end) throw wrong;
  return range;
}

std::vector<std::size_t> posed_frames(const Sequence& sequence, int every, const FrameRange& range) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < std::min(range.end, sequence.size()); i += static_cast<std::size_t>(every)) {
    if (i >= range.begin && sequence.T_world_camera(i)) frames.push_back(i);
  }
  if (frames.empty()) throw InputError(sequence.name(), "no frame in question has a pose");
  return frames;
}

std::string training_frames_line(const Sequence& sequence, int every, const FrameRange& range) {
  const auto step = static_cast<std::size_t>(every);
  const std::size_t begin = (std::min(range.begin, sequence.size()) + step - 1) / step * step;
  return formatted("%s %zu %zu %zu %zu ", training_frames_word, step, begin, std::min(range.end, sequence.size()),
                   sequence.size()) +
         sequence.name();
}

}  // namespace odosplat::apps
