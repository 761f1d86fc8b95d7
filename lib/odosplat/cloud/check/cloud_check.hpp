// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// Determines without any depth image whether and how posed images and a cloud belong together. Patches around the
/// cloud's visible points are projected from one image into another by the poses and compared there by normalised cross
/// correlation, which does not depend on brightness and contrast.
///   1. Readings: all combinations of both signs of fy, cloud as given or mirrored, and poses as stored or inverted;
///      then shifts of the image ids with the best of these and with the declared reading. Readings are compared as in
///      check_conventions(): where two cannot be distinguished, the declared one is kept and reported as not decidable.
///   2. Fit: scale, offset and rotation of the cloud and the focal length, by least squares over the distances between
///      expected and found positions of patches, with gaps up to four times as long (fit_cloud()).
///
/// An error is reported, or the data are said to agree, only if the cloud is then shown to fit, by comparison with two
/// controls (CloudControl). If neither the cloud as given nor the fitted one is shown to fit, other units (mm, cm,
/// inches, feet, and poses in mm or cm) are tried, and one that fits is reported. Otherwise the report says that the
/// cloud does not fit, or that the images do not determine it.
///
/// Not observable, which the report then states: a shift of the ids if the camera moves steadily; scale and offset if
/// it only rotates; everything if it stands still or sees no texture. An offset parallel to a surface is visible only
/// at other surfaces, so a single wall leaves two directions undetermined.
///
/// Throws InputError if there are fewer than two images with a pose, if the cloud is empty, or if an image is not of
/// the camera's size. Deterministic, whatever the number of threads.
CloudCheckReport check_cloud(const CloudCheckInput& input, const CloudCheckOptions& options = {});

/// The parts of a reading as text: "fy +480.0, poses as stored, id shift 0".
std::string reading_text(const CloudReading& reading, const Camera& camera);

/// The rows as aligned text, the winner marked *, the declared reading marked d.
std::string cloud_table(const CloudCheckReport& report, const Camera& camera, std::size_t max_rows = 12);

}  // namespace odosplat
