// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// A method built into `odosplat track`: its flags, and the files that have to be made before it can run.
struct MethodRecipe {
  std::string name;
  std::vector<std::string> flags;
  bool map = false;        // needs a map of Gaussians
  bool paper_map = false;  // needs a map of Gaussians trained with the paper's preset
  bool cloud = false;
};

/// The recipe of that name; null if there is none.
const MethodRecipe* method_recipe(const std::string& name);

/// gaussian, interpolation, surfel, rgbd, paper, and gaussian_no_anchor (gaussian without its anchor).
std::vector<std::string> built_in_methods();

}  // namespace odosplat::apps
