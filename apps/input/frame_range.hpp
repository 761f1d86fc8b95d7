// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Frames begin to end - 1, counted from 0.
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = std::numeric_limits<std::size_t>::max();
};

/// Parses "A:B" as frames A to B - 1. Without A from the first, without B to the last. InputError for other text, and
/// for a range without frames.
FrameRange parse_frames(const std::string& text);

/// Help text of a flag that takes such a range.
inline constexpr const char* frames_help = "A:B: only frames A to B - 1, counted from 0 (default: all)";

/// Those of the frames 0, N, 2N, ... that lie in the range and have a pose; InputError if there are none.
std::vector<std::size_t> posed_frames(const Sequence& sequence, int every, const FrameRange& range = {});

/// First word of the lines of a map's header that name its training frames.
inline constexpr const char* training_frames_word = "training_frames";

/// The line of a map's header for one of its sequences: frames 0, N, 2N, ... within the range were trained on.
std::string training_frames_line(const Sequence& sequence, int every, const FrameRange& range);

}  // namespace odosplat::apps
