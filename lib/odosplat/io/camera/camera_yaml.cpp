// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/yaml_document.hpp"

namespace odosplat {

CameraYaml::CameraYaml(std::string name, std::string text) : name_(std::move(name)) {
  if (text.size() > max_camera_file_size) throw InputError(name_, "is too long for a camera file");
  if (text.rfind("%YAML:", 0) == 0) text.erase(0, std::min(text.find('\n'), text.size()));
  try {
    const std::optional<YAML::Node> document = single_yaml_document(text);
    if (!document) fail("content", "holds several YAML documents (`---`), must hold one");
    root_.reset(*document);
  } catch (const YAML::Exception& e) {
    fail("line " + std::to_string(e.mark.line + 1), yaml_excerpt(e.msg));
  }
  if (!root_.IsMap()) fail("content", "is not a list of `key: value` lines");
  refuse_duplicates();
}

CameraYaml CameraYaml::below(const char* key) const {
  CameraYaml reader;
  reader.name_ = name_;
  reader.place_ = place_ + key + ".";
  reader.root_ = root_[key];
  if (!reader.root_.IsMap()) fail(key, "is not a list of `key: value` lines");
  reader.refuse_duplicates();
  return reader;
}

double CameraYaml::number(const char* key) const {
  if (!has(key)) fail(key, "is missing");
  return number(key, root_[key]);
}

int CameraYaml::integer(const char* key) const {
  const double value = number(key);
  if (value != std::floor(value) || std::abs(value) > 1e6) fail(key, "is not a whole number in range");
  return static_cast<int>(value);
}

std::vector<double> CameraYaml::numbers(const char* key) const {
  if (!has(key)) fail(key, "is missing");
  const YAML::Node list = root_[key];
  if (!list.IsSequence()) fail(key, "is not a list");
  std::vector<double> values;
  for (const YAML::Node& item : list) values.push_back(number(key, item));
  return values;
}

std::string CameraYaml::text(const char* key) const {
  if (!has(key)) fail(key, "is missing");
  if (!root_[key].IsScalar()) fail(key, "is not a text");
  return root_[key].Scalar();
}

void CameraYaml::refuse_unknown(const std::set<std::string>& known) const {
  for (const auto& entry : root_) {
    if (!entry.first.IsScalar()) fail("content", "has a key that is not a word");
    if (known.count(entry.first.Scalar()) == 0) fail(yaml_excerpt(entry.first.Scalar()), "is not a known key");
  }
}

void CameraYaml::fail(const std::string& key, const std::string& fault) const {
  throw InputError(name_, place_ + key, fault);
}

double CameraYaml::number(const char* key, const YAML::Node& node) const {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value)) fail(key, "is not a number");
  if (!std::isfinite(value)) fail(key, "is not finite");
  return value;
}

// The parser accepts duplicate keys: it keeps both entries and returns one of them.
void CameraYaml::refuse_duplicates() const {
  std::map<std::string, int> lines;
  for (const auto& entry : root_) {
    if (!entry.first.IsScalar()) continue;
    const int line = entry.first.Mark().line + 1;
    const auto [first, added] = lines.emplace(entry.first.Scalar(), line);
    if (added) continue;
    fail(yaml_excerpt(first->first),
         "is given twice, in lines " + std::to_string(first->second) + " and " + std::to_string(line));
  }
}

}  // namespace odosplat
