// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "odosplat/core/similarity.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat {

/// Writes a sequence in TUM layout that shows the posed frames of `sequence` in another world, p_target = moved * p:
///   groundtruth.txt  every pose of the sequence, moved
///   rgb.txt          the frames that have a pose; the images stay where they are and are named by absolute path
///   depth.txt        their depth images, if any. Depth is taken to be in the unit of the poses: camera.yaml gets a
///                    depth_scale that is divided by the scale
///   exposures.txt    their exposure times, if known
///   camera.yaml      the camera with its lens distortion and photometric calibration
/// rgb.txt is written last. Returns the number of frames. InputError: no frame has a pose, a video (its frames are no
/// files), a path that no list can hold, a folder that cannot be written. The sequence's own folder is not recognised:
/// its lists would be replaced.
std::size_t write_moved_sequence(const std::string& folder, const Sequence& sequence, const Similarity& moved);

}  // namespace odosplat
