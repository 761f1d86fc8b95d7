// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_file.hpp"

#include <charconv>
#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/camera/camera_of_others.hpp"
#include "odosplat/io/camera/camera_yaml.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {
namespace {

Camera read_camera(const CameraYaml& reader) {
  Camera c;
  c.width = reader.integer("width");
  c.height = reader.integer("height");
  c.fx = reader.number("fx");
  c.fy = reader.number("fy");
  c.cx = reader.number("cx");
  c.cy = reader.number("cy");
  return c;
}

DepthCamera read_depth_camera(const CameraYaml& reader) {
  DepthCamera depth;
  depth.camera = read_camera(reader);
  if (!reader.has("T_color_depth")) reader.fail("T_color_depth", "is missing");
  const std::vector<double> pose = reader.numbers("T_color_depth");
  if (pose.size() != 7) {
    reader.fail("T_color_depth", "must hold 7 numbers (tx ty tz qx qy qz qw), holds " + std::to_string(pose.size()));
  }
  try {
    const Eigen::Quaterniond q = rotation_from_text({pose[6], pose[3], pose[4], pose[5]});
    depth.T_color_depth = SE3(q, {pose[0], pose[1], pose[2]});
  } catch (const InputError& e) {
    reader.fail("T_color_depth", e.what());
  }
  if (reader.has("time_offset")) depth.time_offset = reader.number("time_offset");
  reader.refuse_unknown({"width", "height", "fx", "fy", "cx", "cy", "T_color_depth", "time_offset"});
  return depth;
}

// The shortest text that is read back as the same bits.
std::string shortest(double value) {
  char buffer[32];
  const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return {buffer, result.ptr};
}

// The text as a double-quoted YAML string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

}  // namespace

CameraFile parse_camera_file(const std::string& name, const std::string& text) {
  const CameraYaml reader(name, text);
  const std::optional<CameraFile> other = read_camera_of_others(reader);
  CameraFile file = other.value_or(CameraFile());
  if (!other) {
    file.camera = read_camera(reader);
    if (file.camera.fy < 0.0) {
      file.fy_sign = -1;
      file.camera.fy = -file.camera.fy;
    }
  }
  if (reader.has("depth_scale")) {
    file.depth_scale = reader.number("depth_scale");
    file.has_depth_scale = true;
    if (file.depth_scale <= 0.0) reader.fail("depth_scale", "must be positive");
  }
  if (!other && reader.has("distortion")) {
    file.distortion = reader.numbers("distortion");
    const std::size_t n = file.distortion.size();
    if (n != 0 && n != 4 && n != 5) reader.fail("distortion", "must hold 4 or 5 numbers, holds " + std::to_string(n));
  }
  if (reader.has("fps")) {
    file.fps = reader.number("fps");
    if (file.fps <= 0.0) reader.fail("fps", "must be positive");
  }
  if (reader.has("time_offset")) file.time_offset = reader.number("time_offset");
  if (reader.has("line_time")) file.camera.readout = file.camera.height * reader.number("line_time");
  if (reader.has("gamma")) {
    file.gamma = reader.number("gamma");
    if (file.gamma <= 0.0) reader.fail("gamma", "must be positive");
  }
  if (reader.has("vignette")) file.vignette = reader.text("vignette");
  if (reader.has("depth_camera")) file.depth_camera = read_depth_camera(reader.below("depth_camera"));
  if (!other) {
    reader.refuse_unknown({"width", "height", "fx", "fy", "cx", "cy", "depth_scale", "distortion", "fps", "time_offset",
                           "line_time", "gamma", "vignette", "depth_camera"});
  }
  check_camera(name, file);
  return file;
}

CameraFile read_camera_file(const std::string& path) {
  CameraFile file = parse_camera_file(path, read_file(path, max_camera_file_size));
  if (!file.vignette.empty()) {
    const std::string vignette = listed_file(std::filesystem::path(path).parent_path().string(), file.vignette);
    try {
      require_regular_file(vignette);
    } catch (const InputError& e) {
      throw InputError(path, "vignette", e.what());
    }
  }
  return file;
}

void write_camera_file(const std::string& path, const CameraFile& file) {
  std::string text;
  auto line = [&text](const char* key, const std::string& value) { text += std::string(key) + ": " + value + "\n"; };
  line("width", std::to_string(file.camera.width));
  line("height", std::to_string(file.camera.height));
  line("fx", shortest(file.camera.fx));
  line("fy", shortest(file.fy_sign * file.camera.fy));
  line("cx", shortest(file.camera.cx));
  line("cy", shortest(file.camera.cy));
  line("depth_scale", shortest(file.depth_scale));
  if (!file.distortion.empty()) {
    std::string list;
    for (const double value : file.distortion) list += (list.empty() ? "[" : ", ") + shortest(value);
    line("distortion", list + "]");
  }
  if (file.fps > 0.0) line("fps", shortest(file.fps));
  if (file.time_offset != 0.0) line("time_offset", shortest(file.time_offset));
  if (file.camera.readout != 0.0) line("line_time", shortest(file.camera.readout / file.camera.height));
  if (file.gamma > 0.0) line("gamma", shortest(file.gamma));
  if (!file.vignette.empty()) line("vignette", quoted(file.vignette));
  if (file.depth_camera) {
    const Camera& camera = file.depth_camera->camera;
    const Eigen::Vector3d& t = file.depth_camera->T_color_depth.translation();
    const Eigen::Quaterniond& q = file.depth_camera->T_color_depth.rotation();
    text += "depth_camera:\n";
    line("  width", std::to_string(camera.width));
    line("  height", std::to_string(camera.height));
    line("  fx", shortest(camera.fx));
    line("  fy", shortest(camera.fy));
    line("  cx", shortest(camera.cx));
    line("  cy", shortest(camera.cy));
    std::string pose;
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      pose += (pose.empty() ? "[" : ", ") + shortest(value);
    }
    line("  T_color_depth", pose + "]");
    if (file.depth_camera->time_offset != 0.0) line("  time_offset", shortest(file.depth_camera->time_offset));
  }
  write_file_atomically(path, text);
}

}  // namespace odosplat
