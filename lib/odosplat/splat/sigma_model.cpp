// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/sigma_model.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

using Factor = std::pair<const char*, float SigmaModel::*>;
constexpr std::array<Factor, 4> factors{
    Factor{"sigma_spread", &SigmaModel::spread}, Factor{"sigma_slope_px", &SigmaModel::slope_px},
    Factor{"sigma_depth_share", &SigmaModel::depth_share}, Factor{"sigma_open_share", &SigmaModel::open_share}};

constexpr float most = 100.0F;  // squares of it, times those of depths, stay far below the largest float

}  // namespace

void SigmaModel::check() const {
  for (const auto& [name, factor] : factors) require(this->*factor >= 0.0F && this->*factor <= most, name, "in 0..100");
}

std::vector<std::string> SigmaModel::to_lines() const {
  std::vector<std::string> lines;
  for (const auto& [name, factor] : factors) {
    std::ostringstream line;
    line << name << ' ' << this->*factor;
    lines.push_back(line.str());
  }
  return lines;
}

SigmaModel SigmaModel::from_lines(const std::vector<std::string>& lines) {
  SigmaModel model;
  for (const std::string& line : lines) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    for (const auto& [name, factor] : factors) {
      if (word != name) continue;
      if (!(in >> model.*factor)) throw InputError(name, "must be a number, is \"" + line + "\"");
    }
  }
  model.check();
  return model;
}

}  // namespace odosplat
