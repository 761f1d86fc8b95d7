// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_columns.hpp"

#include <algorithm>
#include <initializer_list>

#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Choice = std::array<const char*, 3>;
using Triple = CloudColumns::Triple;

std::optional<Triple> find_triple(const std::vector<std::string>& names, std::initializer_list<Choice> choices) {
  for (const Choice& choice : choices) {
    Triple triple{};
    bool complete = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found =
          std::find_if(names.begin(), names.end(), [&](const std::string& name) { return same_word(name, choice[i]); });
      triple[i] = static_cast<std::size_t>(found - names.begin());
      complete = complete && found != names.end();
    }
    if (complete) return triple;
  }
  return std::nullopt;
}

}  // namespace

CloudColumns find_cloud_columns(const std::vector<std::string>& names) {
  return {
      find_triple(names, {{"x", "y", "z"}}),
      find_triple(names, {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}}),
      find_triple(names,
                  {{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}, {"normalx", "normaly", "normalz"}})};
}

}  // namespace odosplat
