// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/map_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {

const std::array<const char*, 6> direction_names{"+x", "-x", "+y", "-y", "+z", "-z"};

std::vector<std::string> MapQuality::to_lines() const {
  std::vector<std::string> lines{
      "quality_verdict " + verdict,
      "quality_psnr_db " + formatted("%.2f", psnr_db),
      "quality_depth_error_m " + formatted("%.5f", depth_error_m),
      "quality_depth_error_share " + formatted("%.5f", depth_error_share),
      "quality_images " + std::to_string(images),
      "quality_odd_images " + std::to_string(odd_images),
      "quality_color_inconsistency " + formatted("%.3f", consistency),
      "quality_unseen_share " + formatted("%.4f", coverage.unseen_share),
      "quality_images_a_point " + formatted("%.0f", coverage.images_a_point),
  };
  for (std::size_t k = 0; k < direction_names.size(); ++k)
    lines.push_back(std::string("quality_direction_") + direction_names[k] + " " +
                    formatted("%.3f", coverage.directions[k]));
  return lines;
}

std::optional<MapQuality> MapQuality::from_lines(const std::vector<std::string>& lines) {
  const std::string prefix = "quality_";
  MapQuality quality;
  bool found = false;
  for (const std::string& line : lines) {
    if (!line.starts_with(prefix)) continue;
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string name = line.substr(prefix.size(), blank - prefix.size());
    const std::string rest = blank < line.size() ? line.substr(blank + 1) : std::string();
    if (name == "verdict") {
      quality.verdict = rest;
      quality.good = rest.starts_with("good");
      found = true;
      continue;
    }
    std::istringstream in(rest);
    double value = 0.0;
    if (!(in >> value) || !std::isfinite(value))
      throw InputError(prefix + name, "must be a number, is \"" + rest + "\"");
    if (name == "psnr_db") quality.psnr_db = value;
    if (name == "depth_error_m") quality.depth_error_m = value;
    if (name == "depth_error_share") quality.depth_error_share = value;
    if (name == "images") quality.images = static_cast<int>(std::clamp(value, 0.0, 1e9));
    if (name == "odd_images") quality.odd_images = static_cast<int>(std::clamp(value, 0.0, 1e9));
    if (name == "color_inconsistency") quality.consistency = value;
    if (name == "unseen_share") quality.coverage.unseen_share = value;
    if (name == "images_a_point") quality.coverage.images_a_point = value;
    for (std::size_t k = 0; k < direction_names.size(); ++k)
      if (name == std::string("direction_") + direction_names[k]) quality.coverage.directions[k] = value;
  }
  if (!found) return std::nullopt;
  return quality;
}

}  // namespace odosplat
