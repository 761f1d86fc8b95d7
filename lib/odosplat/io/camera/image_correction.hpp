// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "odosplat/camera/undistort.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/camera/photometric.hpp"

namespace odosplat {

/// What Sequence does to the images of a camera as it reads them, for images that come from elsewhere: vignette and gamma
/// of the camera file are corrected, and then the lens distortion. Const calls are thread safe.
class ImageCorrection {
 public:
  /// camera: as read from `file`, whose folder a relative path of the vignette belongs to. Throws InputError naming the
  /// file: an implausible camera (check_camera), images of more than max_pixels or less than 2x2 pixels, or a vignette
  /// that is missing, damaged or of another size.
  ImageCorrection(const CameraFile& camera, const std::string& file, std::int64_t max_pixels);

  /// rgb: of the camera's size, else InputError naming `name`, both sizes and the camera file.
  GrayImage gray(const std::string& name, const cv::Mat3b& rgb) const;

 private:
  std::string file_;
  cv::Size size_;
  PhotometricCorrection photometric_;
  Undistorter undistorter_;
};

}  // namespace odosplat
