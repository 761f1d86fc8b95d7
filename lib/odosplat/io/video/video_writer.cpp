// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/video_writer.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/quiet_opencv.hpp"
#include "odosplat/io/video/video_reader.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

/// Whether the name has that extension, in upper or lower case.
bool ends_in(const std::string& path, const std::string& ending) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text == ending;
}

bool is_avi(const std::string& path) { return ends_in(path, ".avi"); }

}  // namespace

struct VideoWriter::State {
  explicit State(const std::string& name) : path(name), file(name, TemporaryName::keep_extension) {}

  std::string path;
  AtomicFile file;
  cv::Size size;
  cv::VideoWriter writer;
  std::size_t written = 0;  // frames
};

void check_video_name(const std::string& path) {
  if (is_avi(path) || ends_in(path, ".mp4")) return;
  throw InputError(path, "a video's name must end in .avi or .mp4");
}

VideoWriter::VideoWriter(const std::string& path, cv::Size size, double fps) {
  check_video_name(path);
  require(size.width > 0 && size.height > 0 && size.width % 2 == 0 && size.height % 2 == 0, "size of a video",
          "even and positive");
  require(std::isfinite(fps) && fps > 0.0 && fps <= 1000.0, "frames a second", "more than 0 and at most 1000");
  const MadeFolders made = ensure_output_file(path);
  state_ = std::make_unique<State>(path);
  State& s = *state_;
  const std::string& beside = s.file.temporary_name();
  s.size = size;
  const QuietOpenCv quiet;
  bool open = false;
  try {
    open = is_avi(s.path)
               ? s.writer.open(beside, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), fps, size)
               : s.writer.open(beside, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), fps, size);
  } catch (const cv::Exception&) {
    open = false;
  }
  if (!open) {
    throw InputError(s.path, is_avi(s.path) ? "cannot be written as Motion JPEG"
                                            : "cannot be written as MPEG-4: OpenCV has no FFmpeg that encodes it; .avi "
                                              "needs none");
  }
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const cv::Mat3b& rgb) {
  require(rgb.size() == state_->size, "a video's frame", "of the size of the others");
  cv::Mat3b bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  state_->writer.write(bgr);
  ++state_->written;
}

void VideoWriter::commit() {
  State& s = *state_;
  s.writer.release();
  // OpenCV reports no write errors, so the file is checked by reading it.
  std::size_t there = 0;
  try {
    const VideoReader reader(s.file.temporary_name());
    there = reader.size();
    if (there == s.written && there > 0) reader.frame(there - 1);
  } catch (const InputError&) {
    there = 0;
  }
  if (there == 0 || there != s.written) {
    throw InputError(s.path, "cannot be written: " + std::to_string(there) + " of " + std::to_string(s.written) +
                                 " frames got there; is the disk full?");
  }
  s.file.commit();
}

}  // namespace odosplat
