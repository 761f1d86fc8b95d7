// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {

/// A part of a YAML text with its path, for errors such as "room.yaml: walks[2].frames: is not a number". Internal to
/// this library.
class YamlPart {
 public:
  YamlPart(std::string name, const std::string& text);

  [[noreturn]] void fail(const std::string& fault) const { throw InputError(name_, place_, fault); }

  bool has(const std::string& key) const;
  /// The value of a key, which must exist.
  YamlPart at(const std::string& key) const;
  /// Keys of a map, in their order; throws InputError for a repeated key.
  std::vector<std::string> keys() const;
  /// Elements of a list.
  std::vector<YamlPart> items() const;
  void refuse_other_keys(const std::vector<std::string>& known) const;

  double number(double low, double high) const;
  int integer(int low, int high) const;
  bool boolean() const;
  std::string text() const;
  /// A list of numbers; a single number counts as a list of one.
  std::vector<float> numbers(double low, double high) const;

 private:
  YamlPart(std::string name, std::string place, const YAML::Node& node);
  void expect(bool ok, const char* fault) const {
    if (!ok) fail(fault);
  }

  std::string name_;
  std::string place_;
  YAML::Node node_;
};

}  // namespace odosplat
