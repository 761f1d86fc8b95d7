// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "odosplat/cloud/check/camera_fit.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat::apps {

/// What `odosplat calibrate` is to estimate.
struct CalibrationRequest {
  std::vector<std::string> what;  // of focal, center, distortion, time, line_time, depth; empty: all that can be
  int pairs = CameraFitOptions().pairs;
  bool by_depth_images = true;  // false: by the depth of a map or a cloud
};

/// Fits the sequence's camera. map: opened only where depth is not that of the depth images, once the request is known
/// to be possible. InputError for a request that the sequence does not allow; NoResult if depth images are of another
/// camera, or nothing is measured. Throws Interrupted after Ctrl-C.
CameraFit measure_calibration(const Sequence& sequence, const CalibrationRequest& request,
                              const std::function<MapView&()>& map, const std::function<void(double)>& progress);

/// The declared camera with what of the fit is significant. Warns if the poses fit the declared camera better. NoResult if images, depth and poses agree with no camera, or if there is no such lens.
CameraFile calibrated_camera(const Sequence& sequence, const CameraFit& fit);

}  // namespace odosplat::apps
