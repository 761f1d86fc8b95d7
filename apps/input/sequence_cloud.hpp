// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "apps/input/frame_range.hpp"
#include "odosplat/cloud/cloud_builder.hpp"

namespace odosplat::apps {

/// The cloud of the depth images of every Nth frame in the range with a pose, of sequences in one world frame. Frames
/// that cannot be read are left out, with one warning for each sequence. InputError if no frame has both pose and depth.
/// Throws Interrupted after Ctrl-C.
PointCloud cloud_of_sequences(const std::vector<Sequence>& sequences, const CloudOptions& options, int every,
                              const FrameRange& range);

}  // namespace odosplat::apps
