// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "odosplat/cloud/check/camera_fit.hpp"
#include "odosplat/eval/registration_check.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Numbers of the images that have depth.
std::vector<std::size_t> frames_with_depth(const Sequence& sequence);

/// Whether the depth images are those of the colour camera. Throws Interrupted after a signal.
RegistrationReport depth_registration(const Sequence& sequence);

/// Fits the camera to the images, depth and poses of a sequence whose poses and fy are as declared, whose depth belongs to
/// the colour images, and which is opened as other commands open it (poses reflected where fy is negative). Time offset and
/// readout are left out where poses do not come with times.
CameraFit measure_camera(const Sequence& sequence);

/// Lines for the terminal; empty if nothing was measured. camera: as declared.
std::string camera_table(const CameraFit& fit, const Camera& camera);
/// One sentence: what is wrong, and what is not determined.
std::string camera_verdict(const CameraFit& fit);

/// A measured fit as data; null for what was not estimated or is not determined.
nlohmann::ordered_json camera_fit_json(const CameraFit& fit, const Camera& camera);

}  // namespace odosplat::apps
