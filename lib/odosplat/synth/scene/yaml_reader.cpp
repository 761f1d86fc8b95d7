// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/scene/yaml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "odosplat/core/formatted.hpp"
#include "odosplat/core/yaml_document.hpp"

namespace odosplat {
namespace {

constexpr std::size_t max_text = 4U << 20;

}  // namespace

YamlPart::YamlPart(std::string name, const std::string& text) : name_(std::move(name)), place_("content") {
  if (text.size() > max_text) throw InputError(name_, "is too long for a scene");
  try {
    const std::optional<YAML::Node> document = single_yaml_document(text);
    if (!document) throw InputError(name_, "holds several YAML documents (`---`), must hold one");
    node_.reset(*document);
  } catch (const YAML::Exception& e) {
    throw InputError(name_, "line " + std::to_string(e.mark.line + 1), yaml_excerpt(e.msg));
  }
}

YamlPart::YamlPart(std::string name, std::string place, const YAML::Node& node)
    : name_(std::move(name)), place_(std::move(place)), node_(node) {}

bool YamlPart::has(const std::string& key) const {
  expect(node_.IsMap(), "is not a list of `key: value`");
  return static_cast<bool>(node_[key]);
}

YamlPart YamlPart::at(const std::string& key) const {
  const std::string place = place_ == "content" ? yaml_excerpt(key) : place_ + "." + yaml_excerpt(key);
  if (!has(key)) throw InputError(name_, place, "is missing");
  return {name_, place, node_[key]};
}

std::vector<std::string> YamlPart::keys() const {
  expect(node_.IsMap(), "is not a list of `key: value`");
  std::vector<std::string> found;
  for (const auto& entry : node_) {
    expect(entry.first.IsScalar(), "has a key that is not a word");
    if (std::find(found.begin(), found.end(), entry.first.Scalar()) != found.end()) {
      fail("has the key " + yaml_excerpt(entry.first.Scalar()) + " twice");
    }
    found.push_back(entry.first.Scalar());
  }
  return found;
}

std::vector<YamlPart> YamlPart::items() const {
  expect(node_.IsSequence(), "is not a list");
  std::vector<YamlPart> found;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    found.push_back({name_, place_ + "[" + std::to_string(i) + "]", node_[i]});
  }
  return found;
}

void YamlPart::refuse_other_keys(const std::vector<std::string>& known) const {
  for (const std::string& key : keys()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) at(key).fail("is not a known key");
  }
}

double YamlPart::number(double low, double high) const {
  expect(node_.IsScalar(), "is not a number");
  const std::string& text = node_.Scalar();
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  expect(error == std::errc() && stop == end && std::isfinite(value), "is not a number");
  if (value < low || value > high)
    fail("must be in " + number_text(low) + ".." + number_text(high) + ", is " + number_text(value));
  return value;
}

int YamlPart::integer(int low, int high) const {
  const double value = number(low, high);
  expect(value == std::floor(value), "is not a whole number");
  return static_cast<int>(value);
}

bool YamlPart::boolean() const {
  const std::string word = text();
  if (word != "true" && word != "false") fail("is neither true nor false");
  return word == "true";
}

std::string YamlPart::text() const {
  expect(node_.IsScalar(), "is not a word");
  return node_.Scalar();
}

std::vector<float> YamlPart::numbers(double low, double high) const {
  std::vector<float> values;
  if (node_.IsScalar()) {
    values.push_back(static_cast<float>(number(low, high)));
  } else {
    for (const YamlPart& item : items()) values.push_back(static_cast<float>(item.number(low, high)));
  }
  return values;
}

}  // namespace odosplat
