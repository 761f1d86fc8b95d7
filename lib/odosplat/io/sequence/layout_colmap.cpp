// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// COLMAP models (Schoenberger and Frahm, CVPR 2016), text and binary.
#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/camera/common_camera.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/natural_order.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

// The model's files: folder + "/cameras" + ending.
struct ModelFiles {
  std::string folder;
  std::string ending;
  std::string file(const char* name) const { return join(folder, name + ending); }
};

// An empty folder in the result: there is no model. If both forms exist, the binary one is taken, as in COLMAP.
ModelFiles find_model(const std::string& path) {
  for (const char* below : {"", "sparse", "sparse/0"}) {
    for (const char* ending : {".bin", ".txt"}) {
      ModelFiles files{*below == '\0' ? path : join(path, below), ending};
      if (file_exists(files.file("cameras")) && file_exists(files.file("images"))) return files;
    }
  }
  return {};
}

std::string find_image_folder(const std::string& path, const std::string& first_image) {
  std::string tried;
  for (const char* place : {"images", ".", "../images", "../../images"}) {
    std::string folder = (fs::path(path) / place).lexically_normal().string();
    if (file_exists(listed_file(folder, first_image))) return folder;
    tried += std::string(tried.empty() ? "" : ", ") + place;
  }
  throw InputError(path, "image " + first_image, "is in none of the folders " + tried);
}

// The one camera of all images. Throws InputError if there are several, unless a camera file overrides it.
CameraFile camera_of(const ModelFiles& model, const std::vector<ColmapImage>& images, bool overridden) {
  const ColmapCameras cameras = read_colmap_cameras(model.file("cameras"));
  std::vector<ImageCamera> stated;
  for (const ColmapImage& image : images) {
    const auto found = cameras.find(image.camera_id);
    if (found == cameras.end()) {
      throw InputError(model.file("images"), "image " + image.name,
                       "its camera " + std::to_string(image.camera_id) + " is not among the cameras");
    }
    stated.push_back({"image " + image.name, &found->second});
  }
  if (overridden) return *stated.front().camera;
  return common_camera(model.file("images"), stated,
                       "`colmap feature_extractor --ImageReader.single_camera 1`, or --camera");
}

}  // namespace

bool is_colmap(const std::string& path) { return !find_model(path).folder.empty(); }

SequenceIndex index_colmap(const std::string& path, const SequenceOptions& options) {
  const ModelFiles model = find_model(path);
  if (model.folder.empty()) {
    throw InputError(path, "holds no COLMAP model (cameras and images, .bin or .txt, here, in sparse or in sparse/0)");
  }
  if (file_exists(join(path, "sparse/1/images" + model.ending)) && model.folder == join(path, "sparse/0")) {
    log_warning(path + ": holds several models, reading sparse/0");
  }
  SequenceIndex index;
  const std::vector<ColmapImage> images = read_colmap_images(model.file("images"));
  const bool overridden = !options.camera_file.empty() || file_exists(join(path, "camera.yaml"));
  const CameraFile camera = camera_of(model, images, overridden);
  choose_camera(options, {path}, camera, model.file("cameras"), camera.depth_scale, index);
  const std::string folder = find_image_folder(path, images.front().name);
  NumberedFiles files;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto number = static_cast<long long>(i);
    files.color[number] = listed_file(folder, images[i].name);
    if (images[i].T_world_camera) files.poses[number] = *images[i].T_world_camera;
  }
  if (files.poses.empty()) throw InputError(model.file("images"), "no image has a pose that is finite");
  warn_without_pose(model.file("images"), images.size() - files.poses.size(), images.size());
  fill_numbered(files, index);
  if (file_exists(model.file("points3D"))) index.sparse_points = {model.file("points3D"), read_colmap_points};
  return index;
}

}  // namespace odosplat
