// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/splat/edit/view_weights.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace odosplat::apps {

/// --seen-by and the flags that say how to read it.
struct SeenByFlags {
  SequenceFlags sequence;  // the path may also be a file of poses
  int every = 1;
};

/// Declares --seen-by (returned), --camera, --layout, --max-image-pixels and --every. what: what the views are for.
CLI::Option* add_seen_by_flags(CLI::App* command, SeenByFlags& flags, const std::string& what);

/// Every Nth posed frame of the sequence, or every Nth pose of the file, seen by --camera without its distortion.
/// with_depth: frames with depth as at the time of their depth image, and with it. A depth image that cannot be read
/// counts as not measured, with a warning, as does one whose pose is not known. InputError if there are no poses, or,
/// for those of a file, no camera or one with a negative fy.
std::vector<EditView> read_seen_by(const SeenByFlags& flags, bool with_depth);

/// "icl_office_kt3 (110 views)" for messages and headers.
std::string seen_by_words(const SeenByFlags& flags, std::size_t views);

}  // namespace odosplat::apps
