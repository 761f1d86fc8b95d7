// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "apps/input/frame_range.hpp"
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

}  // namespace odosplat::apps
