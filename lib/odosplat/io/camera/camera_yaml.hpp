// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <vector>

namespace odosplat {

inline constexpr std::size_t max_camera_file_size = 1 << 20;  // [bytes]

/// Access to the values of a camera file: a map of keys, at the top of a YAML document or below a key. Errors are
/// InputError(file, place, fault), with nested keys shown by their place ("depth_camera.fx"). Of all readers of cameras
/// in YAML.
class CameraYaml {
 public:
  /// name stands for the file in errors. InputError for text that is too long, no YAML, of several documents, no map, or
  /// with a key that is given twice. The first line "%YAML:1.0" of OpenCV's files, which is no YAML, is passed over, and so
  /// is an empty last document, which `ros2 topic echo` leaves.
  CameraYaml(std::string name, std::string text);

  bool has(const char* key) const { return static_cast<bool>(root_[key]); }
  bool is_map(const char* key) const { return has(key) && root_[key].IsMap(); }
  /// The map below a key.
  CameraYaml below(const char* key) const;

  /// The value of a key, which must be there and finite.
  double number(const char* key) const;
  int integer(const char* key) const;
  std::vector<double> numbers(const char* key) const;
  std::string text(const char* key) const;

  void refuse_unknown(const std::set<std::string>& known) const;
  [[noreturn]] void fail(const std::string& key, const std::string& fault) const;

 private:
  CameraYaml() = default;
  double number(const char* key, const YAML::Node& node) const;
  void refuse_duplicates() const;

  std::string name_;
  std::string place_;
  YAML::Node root_;
};

}  // namespace odosplat
