// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/image_correction.hpp"

#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {

ImageCorrection::ImageCorrection(const CameraFile& camera, const cv::Mat1f& vignette)
    : undistorter_(camera.camera, camera.distortion),
      photometric_(camera.gamma > 0.0 ? camera.gamma : 1.0, vignette),
      with_vignette_(!vignette.empty()) {}

ColorImage ImageCorrection::color(const ColorImage& taken, double exposure) const {
  return undistorter_.color(photometric_.apply(taken, exposure));
}

std::string vignette_path(const CameraFile& camera, const std::string& file) {
  if (camera.vignette.empty()) return {};
  return listed_file(std::filesystem::path(file).parent_path().string(), camera.vignette);
}

cv::Mat1f vignette_of(const CameraFile& camera, const std::string& file, std::int64_t max_pixels) {
  const std::string path = vignette_path(camera, file);
  if (path.empty()) return {};
  const cv::Size needed(camera.camera.width, camera.camera.height);
  return read_vignette(path, {max_pixels, [&](const cv::Size& size) {
                                if (size == needed) return;
                                throw InputError(
                                    path, "is " + size_text(size) + ", " + file + " is for " + size_text(needed));
                              }});
}

}  // namespace odosplat
