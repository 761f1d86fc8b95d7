// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/io/sequence.hpp"

namespace odosplat::apps {

/// SEQ and the flags that say how to read it.
struct SequenceFlags {
  std::string path;
  SequenceOptions options;
};

/// Declares SEQ (returned), --layout and --camera.
CLI::Option* add_sequence_flags(CLI::App* command, SequenceFlags& flags);

/// --layout and --camera alone, where the sequence has a flag of its own.
void add_layout_flags(CLI::App* command, SequenceFlags& flags);

Sequence open_sequence(const SequenceFlags& flags);

/// Frames 0, N, 2N, ... that have a pose; InputError if there is none.
std::vector<std::size_t> posed_frames(const Sequence& sequence, int every);

}  // namespace odosplat::apps
