// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Frames of a video file by number. Frames that are asked for in order are decoded once; going back starts again at
/// the first, since seeking lands on the right frame with some formats only. All frames are counted at construction,
/// since what a file says of its length is often wrong. InputError if the file is no video or holds no frame. Thread
/// safe.
class VideoReader {
 public:
  explicit VideoReader(std::string path);
  ~VideoReader();

  std::size_t size() const;
  cv::Size frame_size() const;
  /// [1/s], 0 if the file does not say.
  double fps() const;
  /// RGB, i < size(). InputError if it cannot be decoded.
  cv::Mat3b frame(std::size_t i) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
