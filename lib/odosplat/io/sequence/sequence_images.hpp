// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/io/camera/image_correction.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"

namespace odosplat {

/// Removes the depth files from the index if none of them exists. Missing colour files give one warning; if all are
/// missing, throws InputError. name: of the sequence.
void require_files(const std::string& name, SequenceIndex& index);

/// Reads the images of a sequence as Sequence gives them: of the camera's size, undistorted, with the photometric
/// calibration applied, depth in metres and registered. Const calls are thread safe.
class SequenceImages {
 public:
  /// Reads the photometric calibration of the folder. index must outlive this. Throws InputError if the camera's size is
  /// over the limit or that of none of the first images, or too small.
  SequenceImages(const std::string& path, const std::string& layout, const SequenceIndex& index,
                 std::int64_t max_image_pixels);

  ColorImage color(std::size_t i) const;
  /// Precondition: frame i has a depth file.
  DepthImage depth(std::size_t i) const;
  bool has_exposures() const { return !exposures_.empty(); }
  /// Over the median; 1 where it is not known.
  double exposure(std::size_t i) const { return exposures_.empty() ? 1.0 : exposures_.at(i); }

 private:
  void say_assumed_depth_scale() const;
  cv::Size camera_size() const { return {index_.camera.camera.width, index_.camera.camera.height}; }
  ImageLimit any_size() const { return {max_image_pixels_, {}}; }
  ImageLimit camera_size_only(const std::string& file) const;
  void require_camera_size(const std::string& file, const cv::Size& size) const;
  void require_depth_size(const FrameFiles& files, const cv::Size& size) const;
  void require_size_of_images() const;
  void require_sizes(const std::string& path) const;
  void read_exposures_of(const std::string& path);

  std::string layout_;
  const SequenceIndex& index_;
  std::int64_t max_image_pixels_;
  ImageCorrection correction_;
  std::vector<double> exposures_;  // per frame, median 1; empty: not known
  mutable std::once_flag depth_scale_said_;
};

}  // namespace odosplat
