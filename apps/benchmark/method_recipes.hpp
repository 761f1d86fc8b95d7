// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// A method of a benchmark that `odosplat track` brings: its flags, and what it needs made before.
struct MethodRecipe {
  std::string name;
  std::vector<std::string> flags;
  bool map = false;        // of Gaussians
  bool paper_map = false;  // of Gaussians, trained as the paper does
  bool cloud = false;
};

/// The recipe of that name; null if there is none.
const MethodRecipe* method_recipe(const std::string& name);

/// gaussian, interpolation, surfel, rgbd, paper, and gaussian_no_anchor: ours without its anchor.
std::vector<std::string> built_in_methods();

}  // namespace odosplat::apps
