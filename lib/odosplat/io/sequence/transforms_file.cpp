// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/transforms_file.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "odosplat/core/error.hpp"
#include "odosplat/io/camera/common_camera.hpp"
#include "odosplat/io/text/json_text.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "odosplat/io/text/text_words.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;

constexpr double corner_to_centre = 0.5;  // [px]

// Reads values of the file's object or of a frame's, with the place for errors.
class Reader {
 public:
  Reader(std::string name, std::string place) : name_(std::move(name)), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& fault) const {
    throw InputError(name_, place_ + key, fault);
  }

  std::optional<double> number(const Json& json, const char* key) const {
    if (!json.contains(key)) return std::nullopt;
    return finite(json[key], key);
  }
  double finite(const Json& value, const char* key) const {
    if (!value.is_number()) fail(key, "is not a number");
    const double v = value.get<double>();
    if (!std::isfinite(v)) fail(key, "is not finite");
    return v;
  }

  std::string path(const Json& json, const char* key) const {
    if (!json.contains(key)) return "";
    if (!json[key].is_string()) fail(key, "is not a text");
    std::string text = json[key].get<std::string>();
    if (has_control_characters(text)) fail(key, "holds control characters");
    return text;
  }

  // Three rows of four; a fourth row is ignored. NaN where the file has null.
  std::vector<double> matrix(const Json& json, const char* key) const {
    const Json& rows = json[key];
    if (!rows.is_array() || (rows.size() != 3 && rows.size() != 4)) fail(key, "is not a matrix of 3 or 4 rows");
    std::vector<double> values;
    for (std::size_t r = 0; r < 3; ++r) {
      if (!rows[r].is_array() || rows[r].size() != 4) fail(key, "is not a matrix of rows of 4 numbers");
      for (const Json& value : rows[r]) values.push_back(value.is_null() ? std::nan("") : finite(value, key));
    }
    return values;
  }

 private:
  std::string name_;
  std::string place_;
};

void refuse_other_models(const Reader& reader, const Json& json) {
  static const std::set<std::string> read{"OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL"};
  if (json.contains("camera_model")) {
    const std::string model = reader.path(json, "camera_model");
    if (read.count(model) == 0) {
      reader.fail("camera_model", quoted_word(model) + " is not read; read are OPENCV, PINHOLE, SIMPLE_PINHOLE, " +
                                      "SIMPLE_RADIAL, RADIAL");
    }
  }
  if (json.contains("is_fisheye") && json["is_fisheye"] != Json(false)) {
    reader.fail("is_fisheye", "fisheye cameras are not read");
  }
  const std::optional<double> k4 = reader.number(json, "k4");
  if (k4 && *k4 != 0.0) reader.fail("k4", "a fourth radial coefficient is not read");
}

// Sets the values that `json` gives and leaves the others unchanged.
void read_camera(const Reader& reader, const Json& json, TransformsCamera& camera) {
  refuse_other_models(reader, json);
  const auto take = [&](const char* key, std::optional<double>& value) {
    if (const std::optional<double> v = reader.number(json, key)) value = v;
  };
  take("w", camera.width);
  take("h", camera.height);
  take("fl_x", camera.fl_x);
  take("fl_y", camera.fl_y);
  take("camera_angle_x", camera.angle_x);
  take("camera_angle_y", camera.angle_y);
  take("cx", camera.cx);
  take("cy", camera.cy);
  std::vector<double> distortion = camera.distortion;
  distortion.resize(5, 0.0);
  const char* keys[] = {"k1", "k2", "p1", "p2", "k3"};
  bool any = false;
  for (std::size_t i = 0; i < 5; ++i) {
    distortion[i] = reader.number(json, keys[i]).value_or(distortion[i]);
    any = any || distortion[i] != 0.0;
  }
  camera.distortion = any ? distortion : std::vector<double>();
}

double focal_length(const std::string& name, const char* key, double size, double angle) {
  if (!(angle > 0.0 && angle < std::numbers::pi)) throw InputError(name, key, "is not an angle in 0..pi");
  return 0.5 * size / std::tan(0.5 * angle);
}

// Converts camera axes from x right, y up, z backward to x right, y down, z forward.
SE3 turned(const SE3& T_world_gl) {
  return T_world_gl * SE3(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), Eigen::Vector3d::Zero());
}

TransformsFrame read_frame(const Reader& reader, const Json& json) {
  TransformsFrame frame;
  frame.color = reader.path(json, "file_path");
  if (frame.color.empty()) reader.fail("file_path", "is missing");
  frame.depth = reader.path(json, "depth_file_path");
  frame.time = reader.number(json, "timestamp");
  if (!json.contains("transform_matrix") || json["transform_matrix"].is_null()) return frame;
  const std::vector<double> rows = reader.matrix(json, "transform_matrix");
  if (std::any_of(rows.begin(), rows.end(), [](double value) { return std::isnan(value); })) return frame;
  const std::optional<SE3> T_world_gl = pose_from_rows(rows);
  if (!T_world_gl) reader.fail("transform_matrix", "the matrix is no rotation");
  frame.T_world_camera = turned(*T_world_gl);
  return frame;
}

void sort_frames(const std::string& name, std::vector<TransformsFrame>& frames) {
  const bool timed = frames.front().time.has_value();
  for (const TransformsFrame& frame : frames) {
    if (frame.time.has_value() != timed) {
      throw InputError(
          name, "timestamp",
          "is given for some of the frames only: " + frames.front().color + " and " + frame.color + " differ");
    }
  }
  std::stable_sort(frames.begin(), frames.end(), [&](const TransformsFrame& a, const TransformsFrame& b) {
    return timed ? *a.time < *b.time : natural_less(a.color, b.color);
  });
  for (std::size_t i = 1; timed && i < frames.size(); ++i) {
    if (*frames[i].time == *frames[i - 1].time) {
      throw InputError(name, "timestamp", "is the same for " + frames[i - 1].color + " and " + frames[i].color);
    }
  }
}

}  // namespace

CameraFile TransformsCamera::camera(const std::string& name, const cv::Size& size) const {
  const double w = width.value_or(size.width);
  const double h = height.value_or(size.height);
  for (const auto& [key, value] : {std::pair{"w", w}, std::pair{"h", h}}) {
    if (!(value >= 1.0 && value <= 32768.0) || value != std::floor(value)) {
      throw InputError(name, key, "is not a size in 1..32768 pixels");
    }
  }
  if (!fl_x && !angle_x) throw InputError(name, "fl_x", "is missing, and so is camera_angle_x");
  CameraFile file;
  Camera& c = file.camera;
  c.width = static_cast<int>(w);
  c.height = static_cast<int>(h);
  c.fx = fl_x ? *fl_x : focal_length(name, "camera_angle_x", w, *angle_x);
  c.fy = fl_y ? *fl_y : angle_y ? focal_length(name, "camera_angle_y", h, *angle_y) : c.fx;
  c.cx = cx.value_or(0.5 * w) - corner_to_centre;
  c.cy = cy.value_or(0.5 * h) - corner_to_centre;
  file.distortion = distortion;
  try {
    c.check();
  } catch (const InputError& e) {
    throw InputError(name, e.what());
  }
  return file;
}

CameraFile TransformsFile::camera(const std::string& name, const cv::Size& size) const {
  std::vector<CameraFile> cameras;
  for (const TransformsFrame& frame : frames) cameras.push_back(frame.camera.camera(name, size));
  std::vector<ImageCamera> stated;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    stated.push_back({"frame " + std::to_string(i + 1) + " (" + frames[i].color + ")", &cameras[i]});
  }
  return common_camera(name, stated, "split the file by camera, or --camera");
}

TransformsFile parse_transforms(const std::string& name, const std::string& text) {
  const Json json = parse_json_object(name, text);
  const Reader reader(name, "");
  TransformsFile file;
  TransformsCamera shared;
  read_camera(reader, json, shared);
  if (json.contains("applied_transform")) reader.matrix(json, "applied_transform");
  if (const std::optional<double> unit = reader.number(json, "depth_unit_scale_factor")) {
    if (!(*unit > 0.0) || !std::isfinite(1.0 / *unit)) reader.fail("depth_unit_scale_factor", "must be positive");
    file.depth_scale = 1.0 / *unit;
  }
  file.points = reader.path(json, "ply_file_path");
  if (!json.contains("frames") || !json["frames"].is_array()) reader.fail("frames", "is missing or no list");
  for (const Json& entry : json["frames"]) {
    const std::string place = "frame " + std::to_string(file.frames.size() + 1);
    const Reader frame_reader(name, place + ": ");
    if (!entry.is_object()) throw InputError(name, place, "is not an object");
    file.frames.push_back(read_frame(frame_reader, entry));
    file.frames.back().camera = shared;
    read_camera(frame_reader, entry, file.frames.back().camera);
  }
  if (file.frames.empty()) reader.fail("frames", "lists no image");
  if (std::none_of(file.frames.begin(), file.frames.end(), [](const auto& frame) { return frame.T_world_camera; })) {
    reader.fail("frame 1: transform_matrix", "is missing or not finite, as in every frame");
  }
  sort_frames(name, file.frames);
  return file;
}

}  // namespace odosplat
