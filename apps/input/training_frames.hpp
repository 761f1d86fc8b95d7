// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// --skip-every before it is given: what the map's header says.
inline constexpr int skip_as_map_says = -1;

/// Declares --skip-every.
void add_skip_every_flag(CLI::App* command, int& skip_every);

/// A line of a map's header for one of its sequences: frames 0, N, 2N, ... of it, within the range, were trained on.
std::string training_frames_line(const Sequence& sequence, int every, const FrameRange& range);

/// Frames of `sequence` in `range` that the map was not made from. skip_every above 0: all but 0, N, 2N, ...; 0: all;
/// skip_as_map_says: by the header of the file `map` (empty: no map), where the sequence is known by its name and
/// number of frames; all but 0, 10, 20, ... if the header says nothing. A line on the log says which are left out.
/// InputError if the header's lines are broken.
std::vector<std::size_t> frames_not_trained_on(const Sequence& sequence, const FrameRange& range, int skip_every,
                                               const std::string& map);

}  // namespace odosplat::apps
