// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/method_recipes.hpp"

namespace odosplat::apps {
namespace {

// The published methods that "interpolation", "surfel", "rgbd" and "paper" stand for do not relocalise, so
// relocalisation is off for them.
const std::vector<MethodRecipe>& recipes() {
  static const std::vector<MethodRecipe> all{
      {"gaussian", {"--method", "gaussian"}, true, false, false},
      {"interpolation", {"--method", "interpolation", "--relocalise", "off"}, false, false, true},
      {"surfel", {"--method", "surfel", "--relocalise", "off"}, false, false, true},
      {"rgbd", {"--method", "rgbd", "--relocalise", "off"}, false, false, false},
      {"paper", {"--method", "paper", "--relocalise", "off"}, false, true, false},
      {"gaussian_no_anchor", {"--method", "gaussian", "--anchor", "off"}, true, false, false},
  };
  return all;
}

}  // namespace

const MethodRecipe* method_recipe(const std::string& name) {
  for (const MethodRecipe& r : recipes()) {
    if (name == r.name) return &r;
  }
  return nullptr;
}

std::vector<std::string> built_in_methods() {
  std::vector<std::string> names;
  for (const MethodRecipe& r : recipes()) names.push_back(r.name);
  return names;
}

}  // namespace odosplat::apps
