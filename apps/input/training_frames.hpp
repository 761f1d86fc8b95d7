// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Value of --skip-every if it is not given: use the map's header.
inline constexpr int skip_as_map_says = -1;

/// Declares --skip-every.
void add_skip_every_flag(CLI::App* command, int& skip_every);

/// Frames of `sequence` in `range` that the map was not made from. Left out are:
///   skip_every > 0: frames 0, N, 2N, ...
///   skip_every = 0: none
///   skip_as_map_says: those in the header of the file `map` (empty: no map), where the sequence is identified by its
///                     name and number of frames; frames 0, 10, 20, ... if the header names none
/// A log message says which frames are left out. InputError if the header's lines are invalid.
std::vector<std::size_t> frames_not_trained_on(const Sequence& sequence, const FrameRange& range, int skip_every,
                                               const std::string& map);

}  // namespace odosplat::apps
