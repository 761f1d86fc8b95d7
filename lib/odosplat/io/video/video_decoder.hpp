// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace odosplat {

/// One pass through the main video stream of a file, by FFmpeg's libraries, in the order of presentation. (OpenCV's
/// VideoCapture loses the stamps of the last frames if images are stored out of order.)
///
/// Frames that cannot be decoded are skipped, as players do, and counted. Frames that an edit list hides are left out.
/// Only formats that consist of one file are read (no playlists, no lists of files, no devices), and no file other than
/// the named one is opened. Not thread safe.
class VideoDecoder {
 public:
  /// Faults of a file, as far as it was read.
  struct Damage {
    long undecoded = 0;          // images whose data could not be decoded
    long corrupt = 0;            // images that were decoded, but from partly damaged data
    long missing = 0;            // images that the container's index or header declares but that have no data
    double missing_s = 0.0;      // [s] by which the file ends before the time that its header declares
    bool shifts_stamps = false;  // stamps are derived by counting the images, so a missing one shifts all later stamps
    bool any() const { return undecoded > 0 || corrupt > 0 || missing > 0 || missing_s > 0.0; }
  };

  /// Throws InputError if the file is not a video, or if its container asks for it to be shown mirrored or rotated by
  /// an angle that is not a multiple of 90 degrees.
  explicit VideoDecoder(const std::string& path);
  ~VideoDecoder();
  VideoDecoder(VideoDecoder&&) noexcept;
  VideoDecoder& operator=(VideoDecoder&&) noexcept;

  /// Clockwise quarter turns, 0 to 3, by which images are rotated, as the container says that they are to be shown.
  int quarters() const;
  /// True if the container has stamps; bare streams (.h264, .mjpeg) have none. Opens the file once more.
  bool has_stamps() const;
  /// Frames per second as given by the container or the stream; 0 if neither does.
  double rate() const;

  /// Advances to the next frame; false if there is none.
  bool next();
  /// Share of the file's bytes that have been read, 0..1.
  double share_read() const;
  /// To be called after the last frame: before that, frames not yet read count as missing.
  Damage damage() const;
  /// Presentation stamp [s] of this frame; none if the container has none for it.
  std::optional<double> time() const;
  /// The same or, if there is none, FFmpeg's estimate from the order of decoding.
  std::optional<double> best_time() const;
  /// Size of this frame's image after rotation.
  cv::Size size() const;
  /// R, G, B of this frame, rotated as it is to be shown; the same bits on every machine.
  cv::Mat3b image() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace odosplat
