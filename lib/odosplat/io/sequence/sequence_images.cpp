// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/sequence_images.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "odosplat/camera/register_depth.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {

void require_files(const std::string& name, SequenceIndex& index) {
  bool any_depth = false;
  bool wants_depth = false;
  std::size_t missing = 0;
  std::optional<InputError> first_fault;
  for (const FrameFiles& f : index.frames) {
    if (!index.video) {
      try {
        require_regular_file(f.color);
      } catch (const InputError& e) {
        if (missing++ == 0) first_fault = e;
      }
    }
    wants_depth = wants_depth || !f.depth.empty();
    any_depth = any_depth || (!f.depth.empty() && file_exists(f.depth));
  }
  // A missing image, like a damaged one, is an error only when its frame is read; if all are missing, throw here.
  if (first_fault && missing == index.frames.size()) throw *first_fault;
  if (first_fault) {
    log_warning(name + ": " + std::to_string(missing) + " of " + std::to_string(index.frames.size()) +
                " listed images are not there, such as " + first_fault->what());
  }
  if (wants_depth && !any_depth) {
    log_debug(name + ": the listed depth files are not there; reading without depth");
    for (FrameFiles& f : index.frames) f.depth.clear();
  }
}

SequenceImages::SequenceImages(const std::string& path, const std::string& layout, const SequenceIndex& index,
                               std::int64_t max_image_pixels)
    : layout_(layout), index_(index), max_image_pixels_(max_image_pixels) {
  require_sizes(path);
  // Last, because only here has the size in the camera file been verified.
  read_exposures_of(path);
  correction_ = ImageCorrection(index.camera, vignette_of(index.camera, index.camera_source, max_image_pixels));
}

void SequenceImages::require_sizes(const std::string& path) const {
  constexpr int smallest_side = 2;  // [px]
  // The camera's size is checked against the pixel limit too: videos have no image header to check, and undistortion
  // allocates images of the camera's size.
  any_size().check(index_.camera_source, camera_size());
  if (index_.video) {
    require_camera_size(path, index_.video->frame_size());
  } else {
    require_size_of_images();
  }
  // Interpolation and gradients need a neighbouring pixel.
  if (const cv::Size size = camera_size(); size.width < smallest_side || size.height < smallest_side) {
    throw InputError(path, "images of " + size_text(size) + " are too small, must have " +
                               std::to_string(smallest_side) + " pixels each way at least");
  }
}

// Logged once, and only when depth is read, because nothing else needs the scale.
void SequenceImages::say_assumed_depth_scale() const {
  if (index_.camera.has_depth_scale) return;
  std::call_once(depth_scale_said_, [this] {
    log_warning(index_.camera_source + " names no depth_scale: " + number_text(index_.camera.depth_scale) +
                " units per metre are assumed, as is usual for the layout " + layout_);
  });
}

ImageLimit SequenceImages::camera_size_only(const std::string& file) const {
  return {max_image_pixels_, [this, &file](const cv::Size& size) { require_camera_size(file, size); }};
}

void SequenceImages::require_camera_size(const std::string& file, const cv::Size& size) const {
  if (size != camera_size()) {
    throw InputError(file,
                     "is " + size_text(size) + ", " + index_.camera_source + " is for " + size_text(camera_size()));
  }
}

void SequenceImages::require_depth_size(const FrameFiles& files, const cv::Size& size) const {
  if (index_.camera.depth_camera) {
    const Camera& camera = index_.camera.depth_camera->camera;
    if (size == cv::Size(camera.width, camera.height)) return;
    throw InputError(files.depth, "is " + size_text(size) + ", the depth_camera of " + index_.camera_source +
                                      " is for " + size_text({camera.width, camera.height}));
  }
  if (size == camera_size()) return;
  if (const cv::Size color = read_image_size(files.color, any_size()); color != size) {
    throw InputError(files.depth,
                     "is " + size_text(size) + ", its colour image " + files.color + " is " + size_text(color));
  }
  require_camera_size(files.depth, size);
}

// Throws if none of the first images has the camera's size, since the camera is then wrong. A single damaged image or
// one of another size is accepted here and reported when that frame is read.
void SequenceImages::require_size_of_images() const {
  constexpr std::size_t most = 32;  // number of images checked
  std::optional<InputError> first_fault;
  for (std::size_t i = 0; i < std::min(most, index_.frames.size()); ++i) {
    const std::string& file = index_.frames[i].color;
    try {
      read_image_size(file, camera_size_only(file));
      return;
    } catch (const InputError& e) {
      if (!first_fault) first_fault = e;
    }
  }
  if (first_fault) throw *first_fault;
}

void SequenceImages::read_exposures_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return;
  std::vector<double> times;
  for (const FrameFiles& f : index_.frames) times.push_back(f.time);
  exposures_ = read_exposures(path, times);
}

ColorImage SequenceImages::color(std::size_t i) const {
  const FrameFiles& files = index_.frames.at(i);
  ColorImage image;
  if (index_.video) {
    index_.video->frame(i).convertTo(image, CV_32F, 1.0 / 255.0);
  } else {
    image = read_color(files.color, camera_size_only(files.color));
  }
  return correction_.color(image, exposure(i));
}

DepthImage SequenceImages::depth(std::size_t i) const {
  const FrameFiles& files = index_.frames.at(i);
  say_assumed_depth_scale();
  const ImageLimit limit{max_image_pixels_, [&](const cv::Size& size) { require_depth_size(files, size); }};
  const cv::Mat1w raw = read_depth_raw(files.depth, limit);
  DepthImage depth(raw.size());
  const double metres = 1.0 / index_.camera.depth_scale;
  for (int y = 0; y < raw.rows; ++y) {
    const std::uint16_t* from = raw[y];
    float* to = depth[y];
    for (int x = 0; x < raw.cols; ++x) to[x] = from[x] == 65535 ? 0.0F : static_cast<float>(from[x] * metres);
  }
  if (const std::optional<DepthCamera>& other = index_.camera.depth_camera; other) {
    DepthImage registered = registered_depth(depth, other->camera, other->T_color_depth, index_.camera.camera);
    correction_.mask_unseen(registered);
    return registered;
  }
  return correction_.depth(depth);
}

}  // namespace odosplat
