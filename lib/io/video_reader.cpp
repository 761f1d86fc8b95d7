// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video_reader.hpp"

#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/quiet_opencv.hpp"

namespace odosplat {
namespace {

bool open_capture(cv::VideoCapture& capture, const std::string& path) {
  const QuietOpenCv quiet;
  // Not cv::CAP_ANY: its image-sequence backend takes any file with a number in its name for a pattern.
  for (const int backend : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG}) {
    try {
      if (capture.open(path, backend)) return true;
    } catch (const cv::Exception&) {
      capture.release();
    }
  }
  return false;
}

}  // namespace

struct VideoReader::State {
  std::string path;
  std::size_t size = 0;
  cv::Size frame_size;
  double fps = 0.0;
  std::mutex mutex;
  cv::VideoCapture capture;
  std::size_t next = 0;  // number of the frame that the capture gives next
};

VideoReader::VideoReader(std::string path) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = std::move(path);
  require_regular_file(s.path);
  if (!open_capture(s.capture, s.path)) throw InputError(s.path, "is not a video that can be read");
  s.fps = s.capture.get(cv::CAP_PROP_FPS);
  if (!std::isfinite(s.fps) || s.fps < 0.0) s.fps = 0.0;
  s.frame_size = {static_cast<int>(s.capture.get(cv::CAP_PROP_FRAME_WIDTH)),
                  static_cast<int>(s.capture.get(cv::CAP_PROP_FRAME_HEIGHT))};
  while (s.capture.grab()) ++s.size;
  s.next = s.size;
  if (s.size == 0) throw InputError(s.path, "holds no frame");
}

VideoReader::~VideoReader() = default;

std::size_t VideoReader::size() const { return state_->size; }
cv::Size VideoReader::frame_size() const { return state_->frame_size; }
double VideoReader::fps() const { return state_->fps; }

cv::Mat3b VideoReader::frame(std::size_t i) const {
  State& s = *state_;
  const std::lock_guard lock(s.mutex);
  if (i < s.next) {
    if (!open_capture(s.capture, s.path)) throw InputError(s.path, "cannot be read any more");
    s.next = 0;
  }
  while (s.next < i && s.capture.grab()) ++s.next;
  cv::Mat bgr;
  if (s.next != i || !s.capture.read(bgr) || bgr.channels() != 3) {
    throw InputError(s.path, "frame " + std::to_string(i), "cannot be decoded");
  }
  ++s.next;
  cv::Mat3b rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

}  // namespace odosplat
