// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// Finds out without any depth image how posed images and a cloud belong together: patches around the cloud's visible
/// points are carried from one image into another by the poses and compared there (normalised cross correlation, which
/// no brightness or contrast changes). 2 signs of fy x cloud as it is or mirrored x poses as stored or inverted are
/// tried, and shifts of the ids with the best of them and with what is declared. Rows are judged as by
/// check_conventions(): what cannot be told apart is left as declared and called not decidable. Then scale, offset and
/// rotation of the cloud and the focal length are fitted by least squares of where patches are found and where they
/// should be, over gaps up to four times as long (fit_cloud()).
///
/// Nothing is accused, nor the data called in agreement, unless the cloud is shown to fit as it is then (CloudControl).
/// Where neither the cloud as given nor the fit is, other units (mm, cm, inches, feet, and poses in mm or cm) are tried
/// and the one that fits is named; else the report says that the cloud does not fit, or that the images do not tell.
///
/// What does not show: a shift with a camera that moves steadily, scale and offset with one that only turns, anything
/// with one that stands still or sees no texture. The report says so. Offsets along surfaces show only at other
/// surfaces: a single wall leaves two directions open.
///
/// Throws InputError if there are fewer than two images with pose, if the cloud is empty, or if an image is not of the
/// camera's size. Deterministic, whatever the number of threads.
CloudCheckReport check_cloud(const CloudCheckInput& input, const CloudCheckOptions& options = {});

/// "fy +480.0, poses as stored, id shift 0": the parts of a reading.
std::string reading_text(const CloudReading& reading, const Camera& camera);

/// The rows as aligned text, the winner marked *, the declared one d.
std::string cloud_table(const CloudCheckReport& report, const Camera& camera, std::size_t max_rows = 12);

}  // namespace odosplat
