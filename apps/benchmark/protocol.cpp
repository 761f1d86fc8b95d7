// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/protocol.hpp"

#include <algorithm>

#include "apps/benchmark/method_recipes.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {

std::vector<const SuiteSequence*> chosen_sequences(const BenchmarkOptions& options, const Suite& suite) {
  for (const std::string& name : options.sequences) {
    const auto found = std::find_if(suite.sequences.begin(), suite.sequences.end(),
                                    [&](const SuiteSequence& s) { return s.name == name; });
    if (found == suite.sequences.end()) throw InputError("--sequences", "suite " + suite.name + " has no " + name);
  }
  std::vector<const SuiteSequence*> chosen;
  for (const SuiteSequence& s : suite.sequences) {
    const bool asked = std::find(options.sequences.begin(), options.sequences.end(), s.name) != options.sequences.end();
    if (options.sequences.empty() || asked) chosen.push_back(&s);
  }
  return chosen;
}

std::vector<std::string> chosen_methods(const BenchmarkOptions& options, const Suite& suite) {
  std::vector<std::string> methods = options.methods;
  if (methods.empty()) {
    methods = {"gaussian", "interpolation", "surfel", "rgbd", "paper"};
    for (const SuiteMethod& m : suite.methods) methods.push_back(m.name);
  }
  for (const std::string& name : methods) {
    if (std::count(methods.begin(), methods.end(), name) > 1) throw InputError("--methods", name + " is listed twice");
    if (method_recipe(name) == nullptr && own_method(suite, name) == nullptr) {
      std::string known;
      const auto add = [&](const std::string& one) { known.append(known.empty() ? "" : ", ").append(one); };
      for (const std::string& n : built_in_methods()) add(n);
      for (const SuiteMethod& m : suite.methods) add(m.name);
      throw InputError("--methods", "there is no " + name + "; there are " + known);
    }
  }
  return methods;
}

const SuiteMethod* own_method(const Suite& suite, const std::string& name) {
  for (const SuiteMethod& m : suite.methods) {
    if (m.name == name) return &m;
  }
  return nullptr;
}

std::string mapping_in_words(const BenchmarkOptions& options, bool stand_in) {
  const std::string step = std::to_string(mapping_step);
  const std::string made =
      options.mapping == "split"
          ? "maps are made of every " + step +
                "th frame of other sequences of the scene than the tested one: two maps a scene, each of every "
                "other sequence, or, where a scene has one sequence, of its first half, tested on its second"
          : "one map a scene, made of every " + step + "th frame of its tested sequences, as in the paper";
  return made + (stand_in ? "; the cloud is a simulated lidar's"
                          : "; the cloud is the data set's, or made of the mapping frames' depth");
}

std::string quick_in_words(const BenchmarkOptions& options) {
  if (!options.quick) return "";
  return "first " + std::to_string(quick_frames) + " frames of each sequence, maps of " +
         std::to_string(quick_iterations) + " training steps";
}

}  // namespace odosplat::apps
