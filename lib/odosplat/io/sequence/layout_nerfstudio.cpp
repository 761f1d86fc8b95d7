// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// transforms.json as nerfstudio (Tancik et al., SIGGRAPH 2023) and instant-ngp use it.
#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/sequence/transforms_file.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

constexpr const char* endings[] = {".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG"};

// SEQ/transforms.json, or SEQ itself: transforms_train.json and the like.
std::string transforms_of(const std::string& path) {
  return is_transforms(path) ? path : join(path, "transforms.json");
}

// The image that a frame names. Synthetic data sets omit the extension.
std::string image_file(const std::string& folder, const std::string& written) {
  std::string file = fs::path(listed_file(folder, written)).lexically_normal().string();
  if (is_image_name(file) || file_exists(file)) return file;
  for (const char* ending : endings) {
    std::string candidate = fs::path(listed_file(folder, written + ending)).lexically_normal().string();
    if (file_exists(candidate)) return candidate;
  }
  return file + endings[0];
}

// The same for a colour image. Throws InputError if a name without extension matches no file.
std::string color_file(const std::string& folder, const TransformsFrame& frame) {
  std::string file = image_file(folder, frame.color);
  if (!file_exists(file) && !is_image_name(frame.color)) {
    throw InputError(file, "is missing, and so is that name with .jpg or .jpeg");
  }
  return file;
}

}  // namespace

bool is_transforms(const std::string& path) { return extension_of(path) == ".json" && file_exists(path); }
bool is_nerfstudio(const std::string& path) { return file_exists(transforms_of(path)); }

SequenceIndex index_nerfstudio(const std::string& path, const SequenceOptions& options) {
  const std::string file = transforms_of(path);
  const TransformsFile transforms = parse_transforms(file, read_file(file));
  const std::string folder = fs::path(file).parent_path().string();
  SequenceIndex index;
  NumberedFiles files;
  for (std::size_t i = 0; i < transforms.frames.size(); ++i) {
    const TransformsFrame& frame = transforms.frames[i];
    const auto number = static_cast<long long>(i);
    files.color[number] = color_file(folder, frame);
    if (!frame.depth.empty()) files.depth[number] = image_file(folder, frame.depth);
    if (frame.T_world_camera) files.poses[number] = *frame.T_world_camera;
  }
  warn_without_pose(file, transforms.frames.size() - files.poses.size(), transforms.frames.size());
  CameraFile camera;
  if (options.camera_file.empty() && !file_exists(join(folder, "camera.yaml"))) {
    cv::Size size;
    if (!transforms.frames.front().camera.has_size())
      size = read_image_size(files.color[0], {options.max_image_pixels, {}});
    camera = transforms.camera(file, size);
  }
  camera.depth_scale = transforms.depth_scale;
  choose_camera(options, {folder}, camera, file, camera.depth_scale, index);
  index.camera.has_depth_scale = true;  // the format defines a default, so none has to be assumed
  fill_numbered(files, index);
  std::size_t posed = 0;  // index in the truth, which has no entry for frames without a pose
  for (std::size_t i = 0; i < transforms.frames.size(); ++i) {
    const TransformsFrame& frame = transforms.frames[i];
    if (frame.time) index.frames[i].time = *frame.time;
    if (!frame.T_world_camera) continue;
    if (frame.time) index.truth[posed].time = *frame.time;
    ++posed;
  }
  if (!transforms.points.empty()) {
    const std::string points = fs::path(listed_file(folder, transforms.points)).lexically_normal().string();
    if (file_exists(points)) index.sparse_points = {points, read_point_cloud};
  }
  return index;
}

}  // namespace odosplat
