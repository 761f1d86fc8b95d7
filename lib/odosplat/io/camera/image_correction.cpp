// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/image_correction.hpp"

#include <algorithm>
#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {

ImageCorrection::ImageCorrection(const CameraFile& camera, const std::string& file, std::int64_t max_pixels)
    : file_(file), size_(camera.camera.width, camera.camera.height) {
  constexpr int smallest_side = 2;  // [px] interpolation and gradients need a neighbour
  check_camera(file, camera);
  ImageLimit{max_pixels, {}}.check(file, size_);
  if (std::min(size_.width, size_.height) < smallest_side) {
    throw InputError(file, "images of " + size_text(size_) + " are too small");
  }
  undistorter_ = Undistorter(camera.camera, camera.distortion);
  cv::Mat1f vignette;
  if (!camera.vignette.empty()) {
    const std::string path = listed_file(std::filesystem::path(file).parent_path().string(), camera.vignette);
    vignette = read_vignette(path, {max_pixels, [&](const cv::Size& size) {
                                      if (size == size_) return;
                                      throw InputError(
                                          path, "is " + size_text(size) + ", " + file + " is for " + size_text(size_));
                                    }});
  }
  photometric_ = PhotometricCorrection(camera.gamma > 0.0 ? camera.gamma : 1.0, vignette);
}

GrayImage ImageCorrection::gray(const std::string& name, const cv::Mat3b& rgb) const {
  if (rgb.size() != size_) {
    throw InputError(name, "its images are " + size_text(rgb.size()) + ", " + file_ + " is for " + size_text(size_) +
                               ": calibrate at the size of the stream, or set the camera to that of the calibration");
  }
  ColorImage image;
  rgb.convertTo(image, CV_32F, 1.0 / 255.0);
  return to_gray(undistorter_.color(photometric_.apply(image, 1.0)));
}

}  // namespace odosplat
