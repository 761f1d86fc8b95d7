// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>

#include "odosplat/io/image/image_file.hpp"

namespace odosplat {

/// How a sequence is to be read.
struct SequenceOptions {
  std::string layout;       // "" = detect, or: tum icl redwood sevenscenes replica colmap nerfstudio images video
  std::string camera_file;  // camera.yaml used instead of the sequence's own and of the layout's calibration
  bool as_stored = false;   // true: poses are not reflected even if fy is negative (for checking conventions)
  std::int64_t max_image_pixels = ImageLimit::default_max_pixels;  // larger images are refused before decoding
  // Called now and then while a video is read through when it is opened, with the share of it that has been read, 0..1.
  // What it throws ends the opening.
  std::function<void(double share)> progress;

  /// Throws InputError for a layout that is not known, or a limit out of 1..2^30.
  void check() const;
};

}  // namespace odosplat
