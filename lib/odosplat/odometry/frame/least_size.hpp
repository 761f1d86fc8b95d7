// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"

namespace odosplat {

/// InputError if the camera's images are too small (under 16 pixels in width or height) for a camera to be followed or
/// found by them: a descriptor's coarsest level would have no pixels.
void check_least_size(const Camera& camera);

}  // namespace odosplat
