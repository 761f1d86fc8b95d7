// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/map_quality_json.hpp"

namespace odosplat::apps {
namespace {

nlohmann::ordered_json known(double value) { return value >= 0.0 ? nlohmann::ordered_json(value) : nullptr; }

}  // namespace

nlohmann::ordered_json json_of(const MapQuality& quality) {
  nlohmann::ordered_json directions;
  for (std::size_t k = 0; k < direction_names.size(); ++k)
    directions[direction_names[k]] = quality.coverage.directions[k];
  return {{"good", quality.good},
          {"verdict", quality.verdict},
          {"psnr_db", quality.psnr_db},
          {"depth_error_m", known(quality.depth_error_m)},
          {"depth_error_share", known(quality.depth_error_share)},
          {"images", quality.images},
          {"odd_images", quality.odd_images},
          {"color_inconsistency", quality.consistency},
          {"unseen_share", quality.coverage.unseen_share},
          {"images_a_point", quality.coverage.images_a_point},
          {"directions", directions}};
}

}  // namespace odosplat::apps
