// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/live_frames.hpp"

#include <algorithm>
#include <chrono>

#include "apps/command/interrupt.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/video/live_address.hpp"

namespace odosplat::apps {
namespace {

LiveOptions options_of(const TrackJob& job, const CameraFile& camera) {
  LiveOptions options;
  options.size = {camera.camera.width, camera.camera.height};
  options.max_pixels = job.sequence.options.max_image_pixels;
  options.reconnect = job.live.reconnect.value_or(options.reconnect);
  options.open_timeout = job.live.open_timeout.value_or(options.open_timeout);
  return options;
}

/// The camera of the job, before anything of its size is allocated.
CameraFile camera_of(const TrackJob& job) {
  constexpr int smallest_side = 2;  // [px] interpolation and gradients need a neighbour
  const std::string& file = job.sequence.options.camera_file;
  CameraFile camera = read_camera_file(file);
  const cv::Size size(camera.camera.width, camera.camera.height);
  ImageLimit{job.sequence.options.max_image_pixels, {}}.check(file, size);
  if (std::min(size.width, size.height) < smallest_side) {
    throw InputError(file, "images of " + size_text(size) + " are too small");
  }
  return camera;
}

/// Whether the camera file is of the stream's images.
void require_size(const LiveSource& source, const CameraFile& camera, const std::string& file) {
  const cv::Size stated(camera.camera.width, camera.camera.height);
  const std::string degrees = std::to_string(90 * source.quarters()) + " degrees clockwise";
  if (source.size() != stated) {
    throw InputError(source.name(),
                     "its images are " + size_text(source.size()) +
                         (source.quarters() != 0 ? ", turned by " + degrees + " as the stream says" : "") + "; " +
                         file + " is for " + size_text(stated) +
                         ": calibrate at the size of the stream, or set the camera to that of the calibration");
  }
  check_turned_rows(source.name(), source.quarters(), camera.camera, file);
  if (source.quarters() != 0) {
    log_warning(source.name() + ": its images are turned by " + degrees + ", as the stream says; " + file +
                " must be of the turned images");
  }
}

}  // namespace

LiveFrames::LiveFrames(const TrackJob& job)
    : camera_(camera_of(job)),
      correction_(camera_,
                  vignette_of(camera_, job.sequence.options.camera_file, job.sequence.options.max_image_pixels)),
      source_(job.sequence.path, options_of(job, camera_), [] { return interrupted(); }) {
  require_size(source_, camera_, job.sequence.options.camera_file);
}

std::optional<InputFrame> LiveFrames::next(const std::function<bool()>& stopped) {
  constexpr double nap = 0.05;  // [s]
  std::optional<LiveFrame> taken;
  do {
    if (stopped()) return std::nullopt;
    taken = source_.take(nap);  // throws what ended the source
    if (!taken && source_.ended()) return std::nullopt;
  } while (!taken);
  InputFrame frame;
  frame.number = taken->number;
  frame.time = taken->time;
  frame.stamp = StampedPose{taken->time, {}, ""}.stamp();
  frame.dropped = taken->dropped;
  frame.arrival = taken->arrival;
  ColorImage image;
  taken->rgb.convertTo(image, CV_32F, 1.0 / 255.0);
  frame.image = to_gray(correction_.color(image));
  return frame;
}

nlohmann::ordered_json LiveFrames::facts() const {
  const LiveCounts counts = source_.counts();
  const auto utc = std::chrono::system_clock::now().time_since_epoch();
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  return {
      {"source", source_.name()},
      {"live", true},
      {"damaged", counts.damaged},
      {"reconnections", counts.reconnections},
      {"utc_minus_time_s", std::chrono::duration<double>(utc).count() - std::chrono::duration<double>(steady).count()}};
}

void check_live_flags(const TrackJob& job) {
  const std::string shown = shown_address(job.sequence.path);
  if (!job.is_live()) {
    const std::string unused = "is for live sources, and " + shown + " is none";
    if (job.live.reconnect) throw InputError("--reconnect", unused);
    if (job.live.open_timeout) throw InputError("--open-timeout", unused);
    if (job.live.part_frames) throw InputError("--part-frames", unused);
    return;
  }
  const std::string cannot = "cannot be used with a live source (" + shown + ")";
  if (job.sequence.options.camera_file.empty()) {
    throw InputError(shown, "a live source needs a camera file (--camera)");
  }
  if (!job.sequence.options.layout.empty()) throw InputError("--layout", cannot);
  if (!job.frames.empty()) throw InputError("--frames", cannot);
  if (job.start == "truth") throw InputError("--start", "truth " + cannot + ": give auto, or a pose");
  if (job.method == "rgbd") throw InputError("--method", "rgbd " + cannot + ": it has no depth images");
}

}  // namespace odosplat::apps
