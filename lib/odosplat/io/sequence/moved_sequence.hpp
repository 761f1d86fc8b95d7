// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "odosplat/core/similarity.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat {

/// Writes a sequence in TUM layout with the posed frames of `sequence` in another world frame, p_target = moved * p:
///   groundtruth.txt  every pose of the sequence at its own time, transformed
///   rgb.txt          the frames that have a pose; the images stay where they are and are named by absolute path
///   depth.txt        their depth images, if any. Depth is taken to be in the unit of the poses: camera.yaml gets the
///                    depth_scale of `sequence` divided by the scale of `moved`, and the baseline of a depth_camera
///                    times that
///   exposures.txt    their exposure times, if known
///   camera.yaml      the camera with its lens distortion, time offsets and photometric calibration
/// rgb.txt is written last. Returns the number of frames. Throws InputError: no frame has a pose, `sequence` is a video
/// (its frames are not files), a path cannot be written into a list (control characters), the folder cannot be written.
/// The caller must not pass the sequence's own folder: its lists would be replaced without an error.
std::size_t write_moved_sequence(const std::string& folder, const Sequence& sequence, const Similarity& moved);

}  // namespace odosplat
