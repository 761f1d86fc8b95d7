// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace odosplat {

/// Frames of a video file by number, in the order of presentation, turned as the container says that they are to be
/// shown (as players and ffmpeg turn them). Frames that are asked for in order are decoded once; going back starts
/// again at the first, since seeking lands on the right frame with some formats only. All frames are decoded once at
/// construction, for their number and stamps, since what a file says of its length is often wrong; one warning tells of
/// images that it promises and does not hold, and of those that are damaged (VideoDecoder::Damage). InputError if the
/// file is no video or holds no frame, if its frames are not of one size or if their stamps do not grow. Thread safe.
class VideoReader {
 public:
  explicit VideoReader(std::string path);
  ~VideoReader();

  std::size_t size() const;
  /// Of the images as they are handed out.
  cv::Size frame_size() const;
  /// Quarters by which images were turned clockwise, 0 to 3.
  int quarters() const;
  /// Presentation stamp of each frame [s], as the container has it. Containers without stamps for images that are
  /// stored out of order (AVI with B-frames) are read if their rate is constant: frame k is at k / rate then. Empty: a
  /// bare stream, which has none.
  const std::vector<double>& times() const;
  /// RGB, i < size(). InputError if it cannot be decoded.
  cv::Mat3b frame(std::size_t i) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
