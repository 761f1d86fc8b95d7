// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <vector>

#include "odosplat/cloud/check/cloud_material.hpp"

namespace odosplat {

/// Fewer patches of a pair say nothing.
inline constexpr std::size_t least_patches = 40;

/// Two images by their numbers; patches of the first are looked for in the second.
struct ImagePair {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// At most `wanted` pairs of images `gap` apart, evenly spread, that have poses under every shift up to max_shift, or
/// as they are numbered at least.
std::vector<ImagePair> choose_pairs(const CloudMaterial& material, int gap, int wanted, int max_shift);

/// What stands in for the depths of patches: the cloud's own, or those of a control.
enum class PatchDepths {
  cloud,
  flat,    // all of an image's at their median, facing the camera
  distant  // all so far away that no motion of the camera shows
};

/// How well patches agree under a reading, in `world` [material.world(reading.mirrored), or a changed one].
CloudRow measure_row(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                     const std::vector<ImagePair>& pairs, const CloudCheckOptions& options,
                     PatchDepths depths = PatchDepths::cloud);

/// The same with the cloud and with both controls.
CloudControl measure_control(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                             const std::vector<ImagePair>& pairs, const CloudCheckOptions& options);

/// Every reading without shift, then shifts of the best of them and of what is declared; best first. progress: called
/// with the share that is done; may be empty.
std::vector<CloudRow> measure_readings(CloudMaterial& material, const CloudReading& declared,
                                       const std::vector<ImagePair>& pairs, const CloudCheckOptions& options,
                                       const std::function<void(double)>& progress);

}  // namespace odosplat
