// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace odosplat {

/// Frames of a video file by number, in the order of presentation, rotated as the container says that they are to be
/// shown (as players and ffmpeg do). Frames requested in order are decoded once; going back starts again at the first
/// frame, because seeking is exact with some formats only. All frames are decoded once at construction to find their
/// number and stamps, because the length that a file declares is often wrong; one warning reports images that are
/// declared but missing, and those that are damaged (VideoDecoder::Damage). Throws InputError if the file is not a
/// video or has no frame, if its frames differ in size or if their stamps do not increase. Thread safe.
class VideoReader {
 public:
  /// progress: called after each frame of that first pass with the share of the file that has been read, 0..1; what it
  /// throws ends the pass. May be empty.
  explicit VideoReader(std::string path, const std::function<void(double share)>& progress = {});
  ~VideoReader();

  std::size_t size() const;
  /// Size of the images that frame() returns.
  cv::Size frame_size() const;
  /// Clockwise quarter turns by which images were rotated, 0 to 3.
  int quarters() const;
  /// Presentation stamp of each frame [s] from the container. Containers without stamps for images that are stored out
  /// of order (AVI with B-frames) are read if their rate is constant; frame k is then at k / rate. Empty for a bare
  /// stream, which has no stamps.
  const std::vector<double>& times() const;
  /// RGB, i < size(). InputError if it cannot be decoded.
  cv::Mat3b frame(std::size_t i) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
