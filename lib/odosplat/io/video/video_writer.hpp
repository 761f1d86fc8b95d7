// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Writes a video file whose format follows from its name: .avi (Motion JPEG, for which OpenCV needs no other library)
/// or .mp4 (MPEG-4, if OpenCV has FFmpeg). The file is written under a temporary name and renamed by commit(); without
/// commit() nothing is left behind. Missing parent folders are created. Not thread safe; different files may be written
/// by different threads.
class VideoWriter {
 public:
  /// size [px] of all frames, width and height even; fps > 0. Throws InputError for another extension, size or rate,
  /// and if the file or a video of that kind cannot be written.
  VideoWriter(const std::string& path, cv::Size size, double fps);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// RGB, of the size given to the constructor.
  void write(const cv::Mat3b& rgb);
  /// Closes and renames the file. To be called once, after the last frame. Throws InputError if the file does not
  /// contain all frames.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws InputError unless the name has one of the extensions above. To be called before any work.
void check_video_name(const std::string& path);

}  // namespace odosplat
