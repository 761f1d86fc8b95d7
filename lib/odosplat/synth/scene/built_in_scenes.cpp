// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <map>

#include "odosplat/core/error.hpp"
#include "odosplat/synth/scene/scene_description.hpp"

namespace odosplat {

/// data/scenes by name of the file; odosplat_embed() in CMakeLists.txt writes it.
const std::map<std::string_view, std::string_view>& scene_texts();

namespace {

constexpr std::string_view ending = ".yaml";

}  // namespace

std::vector<std::string> built_in_scenes() {
  std::vector<std::string> names;
  for (const auto& [file, text] : scene_texts()) names.emplace_back(file.substr(0, file.size() - ending.size()));
  return names;
}

std::string_view built_in_scene_text(const std::string& name) {
  const auto scene = scene_texts().find(name + std::string(ending));
  if (scene != scene_texts().end()) return scene->second;
  std::string names;
  for (const std::string& known : built_in_scenes()) names += (names.empty() ? "" : ", ") + known;
  throw InputError(name, "is no built-in scene: there are " + names);
}

SceneDescription built_in_scene(const std::string& name) {
  return parse_scene(name, std::string(built_in_scene_text(name)));
}

}  // namespace odosplat
