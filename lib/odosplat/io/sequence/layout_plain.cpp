// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Folders of images without any list, and videos; a camera file gives the camera and the rate.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/natural_order.hpp"

namespace odosplat {
namespace {

constexpr double rate_tolerance = 0.02;

std::vector<std::string> image_names(const std::string& path) {
  std::vector<std::string> names = list_folder(path);
  std::erase_if(names, [](const std::string& name) { return !is_image_name(name); });
  return names;
}

// Phones store videos in landscape format with a rotation for display. The images are read rotated, so the camera file
// must describe the rotated images.
void check_turned(const std::string& path, const VideoReader& video, const SequenceIndex& index) {
  if (video.quarters() == 0) return;
  const Camera& camera = index.camera.camera;
  const cv::Size shown = video.frame_size();
  const std::string degrees = std::to_string(90 * video.quarters()) + " degrees clockwise";
  const bool turned_camera = camera.width == shown.height && camera.height == shown.width;
  if (turned_camera && camera.width != camera.height) {
    throw InputError(path, "is shown turned by " + degrees + ", as " + size_text(shown) + "; " + index.camera_source +
                               " is for " + size_text({camera.width, camera.height}) +
                               ": calibrate with the images as they are shown");
  }
  check_turned_rows(path, video.quarters(), camera, index.camera_source);
  // In these cases the image size does not show whether the camera file is for rotated images.
  if (video.quarters() == 2 || camera.width == camera.height) {
    log_warning(path + ": its images are turned by " + degrees + ", as they are to be shown; " + index.camera_source +
                " must be of the turned images");
  }
}

// The frame rate follows from the stamps; a different rate in the camera file is reported and dropped.
void drop_declared_rate(const std::string& path, SequenceIndex& index) {
  const double declared = std::exchange(index.camera.fps, 0.0);
  if (declared <= 0.0 || index.frames.size() < 2) return;
  const double seconds = index.frames.back().time - index.frames.front().time;
  const double rate = static_cast<double>(index.frames.size() - 1) / seconds;
  if (std::abs(rate - declared) <= rate_tolerance * rate) return;
  log_warning(path + ": " + index.camera_source +
              formatted(" says %.3f frames per second, the video's stamps %.3f: the stamps count", declared, rate));
}

}  // namespace

bool is_image_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error) && !image_names(path).empty();
}

bool is_video(const std::string& path) { return file_exists(path) && !is_transforms(path); }

SequenceIndex index_image_folder(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  choose_camera(options, {path}, std::nullopt, "", 1000.0, index);
  NumberedFiles files;
  for (const std::string& name : image_names(path)) {
    files.color.emplace(static_cast<long long>(files.color.size()), join(path, name));
  }
  if (files.color.empty()) throw InputError(path, "holds no PNG or JPEG file");
  fill_numbered(files, index);
  return index;
}

SequenceIndex index_video(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  if (options.camera_file.empty()) throw InputError(path, "a video needs a camera file (--camera)");
  choose_camera(options, {}, std::nullopt, "", 1000.0, index);
  index.video = std::make_shared<const VideoReader>(path, options.progress);
  check_turned(path, *index.video, index);
  const std::vector<double>& times = index.video->times();
  if (times.empty() && index.camera.fps <= 0.0) {
    throw InputError(path, "is a bare stream without times; give fps in the camera file");
  }
  NumberedFiles files;
  for (std::size_t i = 0; i < index.video->size(); ++i) files.color.emplace(static_cast<long long>(i), "");
  fill_numbered(files, index);
  for (std::size_t i = 0; i < times.size(); ++i) index.frames[i].time = times[i];
  if (!times.empty()) drop_declared_rate(path, index);
  return index;
}

}  // namespace odosplat
