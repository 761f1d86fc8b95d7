// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "odosplat/cloud/check/visible_patches.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double distant_share = 1e-4;  // factor on the inverse depth; so far away that motion causes no visible shift

void level(std::vector<VisiblePatch>& patches, PatchDepths depths) {
  std::vector<double> inverse;
  inverse.reserve(patches.size());
  for (const VisiblePatch& p : patches) inverse.push_back(static_cast<double>(p.inverse_depth));
  const double middle = median_of(std::move(inverse)) * (depths == PatchDepths::distant ? distant_share : 1.0);
  for (VisiblePatch& p : patches) {
    p.inverse_depth = static_cast<float>(middle);
    p.slope_u = p.slope_v = 0.0F;
  }
}

}  // namespace

std::vector<ImagePair> choose_pairs(const CloudMaterial& material, int gap, int wanted, int max_shift) {
  const auto distance = static_cast<std::size_t>(gap);
  std::vector<ImagePair> possible;
  for (const int shift : {max_shift, 0}) {
    const auto usable = [&](std::size_t i) {
      for (const int s : {-shift, 0, shift}) {
        if (!material.pose(i, {1, false, false, s})) return false;
      }
      return true;
    };
    for (std::size_t i = 0; i + distance < material.images(); ++i) {
      if (usable(i) && usable(i + distance)) possible.push_back({i, i + distance});
    }
    if (!possible.empty()) break;
  }
  const std::size_t count = std::min(possible.size(), static_cast<std::size_t>(wanted));
  std::vector<ImagePair> pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.push_back(possible[k * possible.size() / count]);
  return pairs;
}

CloudRow measure_row(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                     const std::vector<ImagePair>& pairs, const CloudCheckOptions& options, PatchDepths depths) {
  CloudRow row;
  row.reading = reading;
  std::vector<double> errors;
  std::size_t tried = 0;
  for (const ImagePair& pair : pairs) {
    row.pair_errors.push_back(not_a_number);
    const std::optional<SE3> from = material.pose(pair.from, reading);
    const std::optional<SE3> to = material.pose(pair.to, reading);
    if (!from || !to) continue;
    ++tried;
    const GrayImage image = material.gray(pair.from);
    const GrayImage other = material.gray(pair.to);
    std::vector<VisiblePatch> patches =
        visible_patches(*world.cloud, *world.spacings, image, world.camera, *from, options.patches);
    if (depths != PatchDepths::cloud) level(patches, depths);
    const SE3 T_other_image = to->inverse() * *from;
    std::vector<std::optional<double>> differences(patches.size());
    parallel_for(static_cast<int>(patches.size()), 64, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        differences[at] = patch_difference(patches[at], image, other, world.camera, T_other_image);
      }
    });
    std::vector<double> seen;
    for (const std::optional<double>& d : differences) {
      if (d) seen.push_back(*d);
    }
    material.count(patches.size());
    if (patches.empty()) continue;
    const double overlap = static_cast<double>(seen.size()) / static_cast<double>(patches.size());
    row.overlap += overlap / static_cast<double>(pairs.size());
    if (seen.size() < least_patches || overlap < options.min_overlap) continue;
    row.pair_errors.back() = median_of(std::move(seen));
    errors.push_back(row.pair_errors.back());
  }
  row.tried = 2 * tried >= pairs.size();
  if (!errors.empty() && 2 * errors.size() >= pairs.size()) row.relative_error = median_of(std::move(errors));
  return row;
}

CloudControl measure_control(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                             const std::vector<ImagePair>& pairs, const CloudCheckOptions& options) {
  const auto row = [&](PatchDepths depths) -> PairScores {
    return measure_row(material, world, reading, pairs, options, depths);
  };
  return {row(PatchDepths::cloud), row(PatchDepths::flat), row(PatchDepths::distant)};
}

std::vector<CloudRow> measure_readings(CloudMaterial& material, const CloudReading& declared,
                                       const std::vector<ImagePair>& pairs, const CloudCheckOptions& options,
                                       const std::function<void(double)>& progress) {
  const double foreseen = 8.0 + 4.0 * options.max_shift;
  std::vector<CloudRow> rows;
  const auto add = [&](const CloudReading& reading) {
    rows.push_back(measure_row(material, material.world(reading.mirrored), reading, pairs, options));
    if (progress) progress(static_cast<double>(rows.size()) / foreseen);
  };
  for (const int sign : {declared.fy_sign, -declared.fy_sign}) {
    for (const bool is_mirrored : {false, true}) {
      for (const bool inverted : {false, true}) {
        add({sign, is_mirrored, inverted, 0});
      }
    }
  }
  const CloudReading best = std::min_element(rows.begin(), rows.end(), [](const CloudRow& a, const CloudRow& b) {
                              return a.relative_error < b.relative_error;
                            })->reading;
  std::vector<CloudReading> shifted{best};
  if (!(best == declared)) shifted.push_back(declared);
  for (CloudReading reading : shifted) {
    for (int shift = 1; shift <= options.max_shift; ++shift) {
      for (const int signed_shift : {-shift, shift}) {
        reading.id_shift = signed_shift;
        add(reading);
      }
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const CloudRow& a, const CloudRow& b) { return a.relative_error < b.relative_error; });
  return rows;
}

}  // namespace odosplat
