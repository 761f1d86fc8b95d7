// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/cloud/check/camera_pairs.hpp"
#include "odosplat/map/map_view.hpp"

namespace odosplat::apps {

/// The depth of the images is that of the map, rendered from where and by the camera by which the images were taken as
/// far as that is known: with the state's time offset, focal length, principal point and distortion. input and map must
/// outlive the input's use.
void take_depth_of_map(CameraFitInput& input, MapView& map);

}  // namespace odosplat::apps
