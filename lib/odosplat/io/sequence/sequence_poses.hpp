// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"

// The poses of a sequence once its layout has been read.
namespace odosplat {

/// All poses of the index are reflected: the y axis of camera and world is inverted.
void reflect_poses(SequenceIndex& index);

/// Sets the poses of all images and depth images by the camera's time offsets. Returns the true poses by the images'
/// stamps if the images have a time_offset; else empty, since index.truth has them. name: of the sequence, for warnings
/// about images without a pose.
Trajectory set_poses(const std::string& name, SequenceIndex& index);

/// Throws InputError if a pose is too far from the origin (require_near_origin).
void require_near(const std::string& name, const SequenceIndex& index);

}  // namespace odosplat
