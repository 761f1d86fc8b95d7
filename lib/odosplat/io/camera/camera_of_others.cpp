// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_of_others.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

namespace odosplat {
namespace {

/// InputError if a model is not among those that are read.
void require_model(const CameraYaml& yaml, const char* key, const std::set<std::string>& read) {
  if (!yaml.has(key)) return;
  const std::string model = yaml.text(key);
  if (read.count(model) > 0) return;
  const std::set<std::string> fisheye{"equidistant", "fisheye", "equi", "kannala_brandt4", "fov", "omni", "ds", "eucm"};
  yaml.fail(key, "`" + model + "` is not read" +
                     (fisheye.count(model) > 0 ? ": fisheye and omnidirectional lenses are not, undistort the images"
                                               : ", only a pinhole camera with radial and tangential distortion"));
}

const std::set<std::string> matrix_models{"plumb_bob", "rational_polynomial", "none", ""};

/// k1 k2 p1 p2 k3; empty if all are 0.
std::vector<double> distortion_of(const CameraYaml& yaml, const char* key) {
  std::vector<double> values = yaml.numbers(key);
  for (std::size_t i = 5; i < values.size(); ++i) {
    if (values[i] != 0.0) {
      yaml.fail(key, "has " + std::to_string(values.size()) +
                         " coefficients; only k1 k2 p1 p2 k3 are read, and the others are not 0");
    }
  }
  if (std::all_of(values.begin(), values.end(), [](double d) { return d == 0.0; })) return {};
  if (values.size() < 4) yaml.fail(key, "must hold 4 or 5 numbers, holds " + std::to_string(values.size()));
  values.resize(std::min<std::size_t>(values.size(), 5));
  return values;
}

void set_matrix(const CameraYaml& yaml, const char* key, Camera& camera) {
  const std::vector<double> k = yaml.numbers(key);
  if (k.size() != 9) yaml.fail(key, "must hold 9 numbers, holds " + std::to_string(k.size()));
  if (std::abs(k[1]) > 1e-6 * std::abs(k[0]) || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    yaml.fail(key, "must be [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  }
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[2];
  camera.cy = k[5];
}

/// The coefficients of a key, as a list or in a matrix's `data`. Where the file names a model they must be there, and
/// with model none they must be 0.
void set_distortion(const CameraYaml& yaml, std::initializer_list<const char*> keys, CameraFile& file) {
  const std::string model = yaml.has("distortion_model") ? yaml.text("distortion_model") : "";
  const char* found = nullptr;
  for (const char* key : keys) {
    if (found == nullptr && yaml.has(key)) found = key;
  }
  if (found == nullptr) {
    if (!model.empty() && model != "none") yaml.fail(*keys.begin(), "is missing for distortion_model " + model);
    return;
  }
  file.distortion = yaml.is_map(found) ? distortion_of(yaml.below(found), "data") : distortion_of(yaml, found);
  if (model == "none" && !file.distortion.empty()) yaml.fail(found, "is not 0, and distortion_model is none");
}

CameraFile read_calibration_form(const CameraYaml& yaml) {
  require_model(yaml, "distortion_model", matrix_models);
  CameraFile file;
  file.camera.width = yaml.integer("image_width");
  file.camera.height = yaml.integer("image_height");
  set_matrix(yaml.below("camera_matrix"), "data", file.camera);
  set_distortion(yaml, {"distortion_coefficients", "dist_coeffs", "dist_coeff"}, file);
  return file;
}

/// matrix, distortion: the keys, whose letters are capital in ROS 1 and small in ROS 2.
CameraFile read_message_form(const CameraYaml& yaml, const char* matrix, const char* distortion) {
  require_model(yaml, "distortion_model", matrix_models);
  for (const char* key : {"binning_x", "binning_y"}) {
    if (yaml.has(key) && yaml.number(key) > 1.0) yaml.fail(key, "binned images are not read");
  }
  CameraFile file;
  file.camera.width = yaml.integer("width");
  file.camera.height = yaml.integer("height");
  set_matrix(yaml, matrix, file.camera);
  set_distortion(yaml, {distortion}, file);
  return file;
}

CameraFile read_list_form(const CameraYaml& yaml) {
  require_model(yaml, "camera_model", {"pinhole"});
  require_model(yaml, "distortion_model", {"radtan", "radial-tangential", "none", "plumb_bob"});
  CameraFile file;
  const std::vector<double> size = yaml.numbers("resolution");
  if (size.size() != 2 || size[0] != std::floor(size[0]) || size[1] != std::floor(size[1]) ||
      std::max(std::abs(size[0]), std::abs(size[1])) > 1e6) {
    yaml.fail("resolution", "must be two whole numbers, width and height");
  }
  file.camera.width = static_cast<int>(size[0]);
  file.camera.height = static_cast<int>(size[1]);
  const std::vector<double> k = yaml.numbers("intrinsics");
  if (k.size() != 4)
    yaml.fail("intrinsics", "must hold fx, fy, cx, cy, holds " + std::to_string(k.size()) + " numbers");
  file.camera.fx = k[0];
  file.camera.fy = k[1];
  file.camera.cx = k[2];
  file.camera.cy = k[3];
  set_distortion(yaml, {"distortion_coeffs", "distortion_coefficients"}, file);
  if (yaml.has("rate_hz")) {
    file.fps = yaml.number("rate_hz");
    if (file.fps <= 0.0) yaml.fail("rate_hz", "must be positive");
  }
  return file;
}

}  // namespace

std::optional<CameraFile> read_camera_of_others(const CameraYaml& yaml) {
  if (yaml.has("camera_matrix")) return read_calibration_form(yaml);
  if (yaml.has("K")) return read_message_form(yaml, "K", "D");
  if (yaml.has("k")) return read_message_form(yaml, "k", "d");
  if (yaml.is_map("cam0")) {
    if (yaml.is_map("cam1")) yaml.fail("cam1", "is a second camera: leave one in the file");
    return read_list_form(yaml.below("cam0"));
  }
  if (yaml.has("intrinsics")) return read_list_form(yaml);
  return std::nullopt;
}

}  // namespace odosplat
