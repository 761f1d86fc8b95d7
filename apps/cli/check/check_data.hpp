// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "apps/cli/check/check_report.hpp"
#include "apps/input/sequence_flags.hpp"

namespace odosplat::apps {

// The parts of `odosplat check`. sequence: opened with SequenceOptions::as_stored. All throw Interrupted after Ctrl-C.

/// Conventions, registration and camera by the depth images, of which there must be some. flags: what the sequence was
/// opened from.
void check_by_depth(const Sequence& sequence, const SequenceFlags& flags, const ConventionOptions& options,
                    CheckResults& results);

CloudCheckReport check_by_cloud(const Sequence& sequence, PointCloud cloud);

/// Texture of up to 100 images, evenly spaced over the sequence and resized to the size at which shares are compared.
TextureSummary texture_of(const Sequence& sequence);

/// Checksum of every file that the sequence lists and of its true poses as read.
std::string checksum_of(const Sequence& sequence);

}  // namespace odosplat::apps
