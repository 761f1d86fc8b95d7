// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/io/camera/camera_file.hpp"

namespace odosplat {

/// The camera that a data set states for one image.
struct ImageCamera {
  std::string image;  // for errors
  const CameraFile* camera = nullptr;
};

/// The single camera of all images, of which there must be at least one. Phones and structure from motion may give
/// intrinsics per image that differ by fractions of a pixel: if no parameter of any image is half a pixel or more from
/// the median (distortion coefficients: multiplied by the focal length), the camera of the medians is returned, and one
/// warning gives the largest difference. `file` stands for the data set in messages. Throws InputError(file, image,
/// fault) if an image differs by more, or in size, because the images then have several cameras. `way_out` is advice
/// for the user, appended to that error.
CameraFile common_camera(const std::string& file, const std::vector<ImageCamera>& images, const std::string& way_out);

}  // namespace odosplat
