// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace odosplat::apps {

/// A sequence (SEQ) and the flags that say how to read it.
struct SequenceFlags {
  std::string path;
  SequenceOptions options;
};

/// Declares SEQ (returned), --layout, --camera and --max-image-pixels.
CLI::Option* add_sequence_flags(CLI::App* command, SequenceFlags& flags);

/// The same flags without SEQ, for commands that give the sequence by a flag of their own.
void add_layout_flags(CLI::App* command, SequenceFlags& flags);

/// --max-image-pixels alone.
void add_image_limit_flag(CLI::App* command, SequenceOptions& options);

/// Opens a sequence; reading a video through, which takes long, is shown once it has taken 2 s and ends when the program
/// is interrupted.
Sequence open_sequence(const std::string& path, const SequenceOptions& options);
Sequence open_sequence(const SequenceFlags& flags);

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

}  // namespace odosplat::apps
