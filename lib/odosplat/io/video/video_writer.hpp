// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// A video file, its format told by its name: .avi (Motion JPEG, which OpenCV writes by itself) or .mp4 (MPEG-4, where
/// OpenCV has FFmpeg). Written beside its place and renamed by commit(); without that nothing is left behind. Missing
/// parent folders are made. Not thread safe; different files may be written by different threads.
class VideoWriter {
 public:
  /// size [px] of all frames, width and height even; fps > 0. InputError for another ending, size or rate, and where
  /// the file or such a video cannot be written.
  VideoWriter(std::string path, cv::Size size, double fps);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// RGB of the size announced.
  void write(const cv::Mat3b& rgb);
  /// Closes and renames. To be called once, after the last frame; InputError if nothing came of it.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// InputError unless the name has one of the endings above: before anything is computed for it.
void check_video_name(const std::string& path);

}  // namespace odosplat
