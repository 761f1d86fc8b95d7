// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/cloud/check/camera_pairs.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Images, poses and depth images of a sequence for fit_camera, halved until they are at most 800 pixels wide. Depth images
/// of another time than their colour images are moved to those's poses; a depth_camera's are registered with the colour
/// camera as declared. Reading throws Interrupted after a signal. The sequence must outlive the result.
CameraFitInput camera_fit_input(const Sequence& sequence);

}  // namespace odosplat::apps
