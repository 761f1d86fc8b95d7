// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A depth image as the colour camera would see it: z [m] along the colour camera's optical axis, of the colour camera's
/// size, 0 = no depth. T_color_depth: p_color = T_color_depth * p_depth.
/// Neighbouring depth pixels of one surface (depths that differ by at most 5 %) span triangles, which are drawn with
/// inverse depth linear in the image, as it is on a plane; where several cover a pixel, the nearest counts. Pixels of
/// the colour image that no triangle covers have no depth: what the depth camera did not see, and a rim of up to one
/// depth pixel at depth edges, where a surface behind may show through. Depth must be dense: a pixel without valid
/// neighbours is lost. Points nearer than 5 cm to the colour camera are left out.
/// InputError unless depth has depth_camera's size. Deterministic; one thread.
DepthImage registered_depth(const DepthImage& depth, const Camera& depth_camera, const SE3& T_color_depth,
                            const Camera& color_camera);

}  // namespace odosplat
