// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/cloud/check/camera_pairs.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Images, poses and depth images of a sequence for fit_camera, halved until they are at most 800 pixels wide. A depth
/// image taken at another time than its colour image is moved to the colour image's pose; those of a depth_camera are
/// registered with the colour camera as declared. Images are read when they are first asked for and kept, up to 512 MiB
/// together; those beyond that are read again each time. Reading throws Interrupted after a signal. The sequence must
/// outlive the result, whose functions are for one thread.
CameraFitInput camera_fit_input(const Sequence& sequence);

}  // namespace odosplat::apps
