// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "apps/python/arrays.hpp"
#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/camera/image_correction.hpp"

namespace odosplat::python {

/// From the attributes of Python's odosplat.Camera. InputError for what check_camera refuses.
CameraFile camera_from(const py::handle& camera, const std::string& name = "camera");
/// The arguments of odosplat.Camera.
py::dict fields_of(const CameraFile& file);

/// Turns a camera's images into those of a pinhole camera without vignetting, as Sequence does.
class ImageInput {
 public:
  /// Reads the vignette, if there is one.
  ImageInput(const CameraFile& camera, ColorOrder order);

  const Camera& camera() const { return camera_; }
  /// Checks and copies; needs the interpreter's lock.
  RawImage take(const py::handle& image, const std::string& name = "image") const {
    return image_from(image, order_, {camera_.width, camera_.height}, name);
  }
  ColorImage color(const RawImage& image) const;
  GrayImage gray(const RawImage& image) const;
  DepthImage depth(const DepthImage& depth) const { return correction_.depth(depth); }

 private:
  Camera camera_;
  ColorOrder order_;
  ImageCorrection correction_;
};

}  // namespace odosplat::python
