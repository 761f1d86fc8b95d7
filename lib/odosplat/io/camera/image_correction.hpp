// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/camera/undistort.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/camera/photometric.hpp"

namespace odosplat {

/// What the images of a camera go through before they are used, wherever they come from: vignette and gamma of the camera
/// file are corrected, and then the lens distortion. Images must have the camera's size. Const calls are thread safe.
class ImageCorrection {
 public:
  /// The identity.
  ImageCorrection() = default;
  /// camera: plausible (check_camera). vignette: of its size (vignette_of); empty: none.
  ImageCorrection(const CameraFile& camera, const cv::Mat1f& vignette);

  /// Color images of exposure 1 and depth images are returned as they are.
  bool is_identity() const { return undistorter_.is_identity() && !with_vignette_; }
  /// exposure: as that of PhotometricCorrection.
  ColorImage color(const ColorImage& taken, double exposure = 1.0) const;
  DepthImage depth(const DepthImage& taken) const { return undistorter_.depth(taken); }
  /// As Undistorter: for depth that is registered to the corrected images already.
  void mask_unseen(DepthImage& depth) const { undistorter_.mask_unseen(depth); }

 private:
  Undistorter undistorter_;
  PhotometricCorrection photometric_;
  bool with_vignette_ = false;
};

/// Path of a camera's vignette, which is relative to the folder of its file; empty if it has none.
std::string vignette_path(const CameraFile& camera, const std::string& file);

/// The vignette of a camera; empty if it has none. file: that of the camera, for the path and for errors. InputError for
/// one that is missing, damaged, or not of the camera's size.
cv::Mat1f vignette_of(const CameraFile& camera, const std::string& file, std::int64_t max_pixels);

}  // namespace odosplat
