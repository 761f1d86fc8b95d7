// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_units.hpp"

#include <algorithm>

#include "odosplat/cloud/check/cloud_rows.hpp"
#include "odosplat/cloud/length_units.hpp"

namespace odosplat {
namespace {

// Enough for beats(), and a fraction of the work of a whole check.
constexpr int pairs_wanted = 8;
constexpr int patches_wanted = 400;

}  // namespace

std::optional<double> likely_unit(CloudMaterial& material, const CloudCheckReport& report,
                                  const CloudCheckOptions& options) {
  CloudCheckOptions fewer = options;
  fewer.pairs = std::min(options.pairs, pairs_wanted);
  fewer.patches = std::min(options.patches, patches_wanted);
  std::vector<CloudReading> readings{report.declared};
  if (!(report.winner == report.declared)) readings.push_back(report.winner);
  std::optional<double> best;
  const auto longest = static_cast<int>(std::max<std::size_t>(1, material.images() / 3));
  for (int gap = std::min(options.gap, longest); gap >= 1; gap /= 2) {
    const std::vector<ImagePair> pairs = choose_pairs(material, gap, fewer.pairs, options.max_shift);
    if (pairs.empty()) continue;
    double least = options.max_error;
    for (const CloudReading& reading : readings) {
      material.set_cloud_scale(1.0);
      const CloudRow given = measure_row(material, material.world(reading.mirrored), reading, pairs, fewer);
      for (const CoordinateUnit& unit : length_units) {
        material.set_cloud_scale(1.0 / unit.times);
        const PatchWorld world = material.world(reading.mirrored);
        const CloudRow row = measure_row(material, world, reading, pairs, fewer);
        if (row.relative_error < least && beats(row, given)) {
          const CloudControl control = measure_control(material, world, reading, pairs, fewer);
          if (beats(control.cloud, control.flat) && beats(control.cloud, control.distant)) {
            least = row.relative_error;
            best = 1.0 / unit.times;
          }
        }
      }
    }
    if (best) break;
  }
  material.set_cloud_scale(1.0);
  return best;
}

}  // namespace odosplat
