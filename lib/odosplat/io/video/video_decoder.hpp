// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace odosplat {

/// One pass through the first video stream of a file, by FFmpeg's libraries, in the order of presentation. (OpenCV's
/// VideoCapture forgets the stamps of the last frames where images are stored out of order.)
///
/// Frames that cannot be decoded are passed over, as players do, and counted. Frames that an edit list hides are not
/// given. Only formats that are one file are read (no playlists, no lists of files, no devices), and the named file and
/// no other. Not thread safe.
class VideoDecoder {
 public:
  /// What is amiss with a file, as far as it was read.
  struct Damage {
    long undecoded = 0;          // images whose data could not be decoded
    long corrupt = 0;            // images that were decoded from damaged data, in part
    long missing = 0;            // images that the container's index or header promises, and whose data are not there
    double missing_s = 0.0;      // [s] by which the file ends before the time that its header promises
    bool shifts_stamps = false;  // stamps are counted from the images there are, so that a missing one shifts the rest
    bool any() const { return undecoded > 0 || corrupt > 0 || missing > 0 || missing_s > 0.0; }
  };

  /// InputError if the file is no video, or is to be shown mirrored or turned by other than quarters.
  explicit VideoDecoder(const std::string& path);
  ~VideoDecoder();
  VideoDecoder(VideoDecoder&&) noexcept;
  VideoDecoder& operator=(VideoDecoder&&) noexcept;

  /// Quarters by which images are turned clockwise, as the container says that they are to be shown: 0 to 3.
  int quarters() const;
  /// True if the container has stamps at all: bare streams (.h264, .mjpeg) have none. Opens the file once more.
  bool has_stamps() const;
  /// Images a second, as the container or the stream says, 0 if they do not.
  double rate() const;

  /// Goes to the next frame; false behind the last.
  bool next();
  /// To be asked behind the last frame: before, whatever comes seems to be missing.
  Damage damage() const;
  /// Presentation stamp [s] of this frame; none if the container has none for it.
  std::optional<double> time() const;
  /// The same or, where there is none, what FFmpeg makes of the order of decoding.
  std::optional<double> best_time() const;
  /// Size of this frame's image as it is shown.
  cv::Size size() const;
  /// R, G, B of this frame, turned as it is shown; the same bits on every machine.
  cv::Mat3b image() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
