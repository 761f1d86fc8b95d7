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

/// The one camera of all images, of which there is at least one. Phones and structure from motion may state intrinsics
/// per image that differ by fractions of a pixel: if no parameter of any image is half a pixel or more from the median
/// (coefficients of distortion: times the focal length), the medians are the camera, and one warning tells the largest
/// difference. `file` stands for the data set in messages. InputError(file, image, fault) if an image differs by more,
/// or in size: those are several cameras. `way_out` ends that error.
CameraFile common_camera(const std::string& file, const std::vector<ImageCamera>& images, const std::string& way_out);

}  // namespace odosplat
