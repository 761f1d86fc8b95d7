// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Layouts whose files carry frame numbers: Redwood (Choi, Zhou, Koltun, CVPR 2015), 7-Scenes (Shotton et al., CVPR
// 2013), Replica as rendered for iMAP and NICE-SLAM (Sucar et al., ICCV 2021).
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/text/file_names.hpp"
#include "odosplat/io/text/json_text.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<std::string> list_if_folder(const std::string& path) {
  return is_folder(path) ? list_folder(path) : std::vector<std::string>();
}

// "00012.jpg" to {12, path}, for the names that `wanted` accepts. Throws InputError if two files have the same number.
template <typename Wanted>
std::map<long long, std::string> numbered_images(const std::string& folder, Wanted wanted) {
  std::map<long long, std::string> images;
  for (const std::string& name : list_folder(folder)) {
    if (!is_image_name(name) || !wanted(name)) continue;
    const long long number = number_in(name.substr(0, name.find('.')));
    if (number < 0) throw InputError(join(folder, name), "has no number in its name");
    const auto [place, added] = images.emplace(number, join(folder, name));
    if (!added) throw InputError(join(folder, name), "has the same number as " + place->second);
  }
  return images;
}

// NAME of the only folder NAME-color; empty if there is none.
std::string redwood_scene(const std::string& path) {
  const std::string ending = "-color";
  std::string scene;
  for (const std::string& name : list_if_folder(path)) {
    if (!name.ends_with(ending) || !is_folder(join(path, name))) continue;
    if (!scene.empty()) throw InputError(path, "holds more than one *-color folder");
    scene = name.substr(0, name.size() - ending.size());
  }
  return scene;
}

// The folder of depth images; the noise-free one (NAME-depth-clean) if a download has several.
std::string redwood_depth_folder(const std::string& path, const std::string& scene) {
  std::string first;
  for (const std::string& name : list_folder(path)) {
    if (!name.starts_with(scene + "-depth") || !is_folder(join(path, name))) continue;
    if (name == scene + "-depth-clean") return join(path, name);
    if (first.empty()) first = join(path, name);
  }
  return first;
}

bool is_frame_color(const std::string& name) {
  return name.starts_with("frame-") && name.find(".color.") != std::string::npos && is_image_name(name);
}

// The folder itself, or its only seq-NN; empty if it is neither.
std::string sevenscenes_folder(const std::string& path) {
  std::string sequences;
  std::string found;
  for (const std::string& name : list_if_folder(path)) {
    if (is_frame_color(name)) return path;
    if (!name.starts_with("seq-") || !is_folder(join(path, name))) continue;
    sequences += (sequences.empty() ? "" : ", ") + name;
    found = join(path, name);
  }
  if (sequences.find(',') != std::string::npos)
    throw InputError(path, "holds several sequences, name one: " + sequences);
  return found;
}

std::string folder_above(const std::string& path) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return (absolute.has_filename() ? absolute : absolute.parent_path()).parent_path().string();
}

double json_number(const std::string& file, const nlohmann::json& camera, const char* key) {
  if (!camera.contains(key)) throw InputError(file, key, "is missing");
  if (!camera[key].is_number()) throw InputError(file, key, "is not a number");
  return camera[key].get<double>();
}

int json_size(const std::string& file, const nlohmann::json& camera, const char* key) {
  const double value = json_number(file, camera, key);
  if (!(value >= 1.0 && value <= 32768.0) || value != std::floor(value)) {
    throw InputError(file, key, "is not a size in pixels");
  }
  return static_cast<int>(value);
}

CameraFile read_replica_camera(const std::string& file) {
  const nlohmann::json json = parse_json_object(file, read_file(file));
  if (!json.contains("camera") || !json["camera"].is_object()) throw InputError(file, "camera", "is missing");
  const nlohmann::json& camera = json["camera"];
  const int width = json_size(file, camera, "w");
  const int height = json_size(file, camera, "h");
  const double fx = json_number(file, camera, "fx");
  const double fy = json_number(file, camera, "fy");
  const double cx = json_number(file, camera, "cx");
  const double cy = json_number(file, camera, "cy");
  CameraFile read = published_camera(width, height, fx, fy, cx, cy, json_number(file, camera, "scale"));
  try {
    read.camera.check();
  } catch (const InputError& e) {
    throw InputError(file, e.what());
  }
  if (!(read.depth_scale > 0.0)) throw InputError(file, "scale", "must be positive");
  return read;
}

}  // namespace

bool is_redwood(const std::string& path) { return !redwood_scene(path).empty(); }
bool is_sevenscenes(const std::string& path) { return !sevenscenes_folder(path).empty(); }

bool is_replica(const std::string& path) {
  for (const std::string& name : list_if_folder(join(path, "results"))) {
    if (name.starts_with("frame") && is_image_name(name)) return true;
  }
  return false;
}

SequenceIndex index_redwood(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  const std::string scene = redwood_scene(path);
  if (scene.empty()) throw InputError(path, "holds no *-color folder");
  const CameraFile published = published_camera(640, 480, 525.0, 525.0, 319.5, 239.5, 1000.0);
  choose_camera(options, {path}, published, "the published camera of Redwood", published.depth_scale, index);
  const auto any = [](const std::string&) { return true; };
  NumberedFiles files;
  const std::string colors = join(path, scene + "-color");
  files.color = numbered_images(colors, any);
  if (files.color.empty()) throw InputError(colors, "holds no image");
  const std::string depths = redwood_depth_folder(path, scene);
  if (!depths.empty()) files.depth = numbered_images(depths, any);
  for (const char* ending : {"-traj.txt", ".log"}) {
    const std::string truth = join(path, scene + ending);
    if (files.poses.empty() && file_exists(truth)) files.poses = read_numbered_poses(truth);
  }
  fill_numbered(files, index);
  return index;
}

namespace {

// The cameras of 7-Scenes: the focal length of colour by structure from motion (Brachmann et al. 2021), the motion
// between the two by a public calibration of a Kinect of the same kind, as DSAC* and ACE use it.
CameraFile sevenscenes_camera() {
  CameraFile file = published_camera(640, 480, 525.0, 525.0, 320.0, 240.0, 1000.0);
  Eigen::Matrix3d R_color_depth;
  R_color_depth << 9.9996518012567637e-01, 2.6765126468950343e-03, -7.9041012313000904e-03,  //
      -2.7409311281316700e-03, 9.9996302803027592e-01, -8.1504520778013286e-03,              //
      7.8819942130445332e-03, 8.1718328771890631e-03, 9.9993554558014031e-01;
  const Eigen::Vector3d t_color_depth(-2.5558943178152542e-02, 1.0109636268061706e-04, 2.0318321729487039e-03);
  file.depth_camera = DepthCamera{{640, 480, 585.0, 585.0, 320.0, 240.0}, SE3(R_color_depth, t_color_depth), 0.0};
  return file;
}

}  // namespace

SequenceIndex index_sevenscenes(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  const std::string folder = sevenscenes_folder(path);
  if (folder.empty()) throw InputError(path, "holds no frame-*.color.png and no seq-*");
  const CameraFile published = sevenscenes_camera();
  choose_camera(options, {folder, folder_above(folder)}, published, "the published cameras of 7-Scenes",
                published.depth_scale, index);
  NumberedFiles files;
  files.color = numbered_images(folder, is_frame_color);
  if (files.color.empty()) throw InputError(folder, "holds no image");
  files.depth = numbered_images(folder, [](const std::string& name) { return name.ends_with(".depth.png"); });
  for (const std::string& name : list_folder(folder)) {
    if (!name.ends_with(".pose.txt")) continue;
    const long long number = number_in(name.substr(0, name.find('.')));
    if (number < 0) continue;
    const std::optional<SE3> T_world_depth = read_pose_matrix(join(folder, name));
    if (!T_world_depth) continue;
    const std::optional<DepthCamera>& depth_camera = index.camera.depth_camera;
    files.poses[number] = depth_camera ? *T_world_depth * depth_camera->T_color_depth.inverse() : *T_world_depth;
  }
  if (!index.camera.depth_camera && !files.poses.empty()) {
    log_warning(index.camera_source + " has no depth_camera: the poses of " + folder +
                ", which 7-Scenes gives for the depth camera, are taken to be the colour camera's");
  }
  const auto without = std::count_if(files.color.begin(), files.color.end(),
                                     [&](const auto& image) { return files.poses.count(image.first) == 0; });
  warn_without_pose(folder, static_cast<std::size_t>(without), files.color.size());
  fill_numbered(files, index);
  return index;
}

SequenceIndex index_replica(const std::string& path, const SequenceOptions& options) {
  SequenceIndex index;
  std::optional<CameraFile> own;
  std::string own_name;
  for (const std::string& folder : {path, folder_above(path)}) {
    const std::string candidate = join(folder, "cam_params.json");
    if (own || !options.camera_file.empty() || !file_exists(candidate)) continue;
    own = read_replica_camera(candidate);
    own_name = candidate;
  }
  choose_camera(options, {path, folder_above(path)}, own, own_name, 6553.5, index);
  const std::string results = join(path, "results");
  NumberedFiles files;
  files.color = numbered_images(results, [](const std::string& name) { return name.starts_with("frame"); });
  files.depth = numbered_images(results, [](const std::string& name) { return name.starts_with("depth"); });
  if (files.color.empty()) throw InputError(results, "holds no image");
  const std::string truth = join(path, "traj.txt");
  if (file_exists(truth)) files.poses = read_numbered_poses(truth);
  fill_numbered(files, index);
  return index;
}

}  // namespace odosplat
