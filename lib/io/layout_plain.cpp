// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Images without any list, and videos: a camera file says the rest.
#include <algorithm>
#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/layouts.hpp"
#include "odosplat/io/natural_order.hpp"

namespace odosplat {
namespace {

std::vector<std::string> image_names(const std::string& path) {
  std::vector<std::string> names = list_folder(path);
  std::erase_if(names, [](const std::string& name) { return !is_image_name(name); });
  return names;
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
  index.video = std::make_shared<const VideoReader>(path);
  if (index.camera.fps <= 0.0) index.camera.fps = index.video->fps();
  NumberedFiles files;
  for (std::size_t i = 0; i < index.video->size(); ++i) files.color.emplace(static_cast<long long>(i), "");
  fill_numbered(files, index);
  return index;
}

}  // namespace odosplat
