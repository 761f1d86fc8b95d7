// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/camera/camera_correction.hpp"

namespace odosplat {

/// A camera as a camera file declares it.
struct Lens {
  Camera camera;
  std::vector<double> distortion;  // k1 k2 p1 p2 k3, or without k3 (Undistorter); empty: none
};

/// The lens that is to be declared instead of `as_declared`, so that undistorted images are without the errors
/// `correction` that were found in images undistorted with `as_declared`. undistorted: the pinhole camera of those
/// images. A ray (x, y) at depth 1 is seen in the image as taken at
///   as_declared(x', y') with (x', y') = undistorted.ray(correction.project(undistorted, (x, y))).
/// Without declared distortion the answer is exact. Else focal lengths, principal point and as many coefficients as are
/// declared are fitted to this map by Gauss-Newton, on a grid over the undistorted image where the image as taken shows
/// it; the model cannot express every such map, above all not a principal point that is far off in a lens that distorts
/// strongly. correction.readout is not used. Throws InputError("distortion", fault) if the fitted lens is off by more
/// than 0.2 px (root of the mean square over the grid).
Lens combined_lens(const Lens& as_declared, const Camera& undistorted, const CameraCorrection& correction);

}  // namespace odosplat
