// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/cloud/check/camera_fit.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// The content of the file for --json of `odosplat calibrate`: what was measured with standard deviations, which parts
/// the images do not determine, and the camera that was written.
std::string calibration_json(const Sequence& sequence, const CameraFile& written, const CameraFit& fit);

}  // namespace odosplat::apps
