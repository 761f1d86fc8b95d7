// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <vector>

#include "odosplat/cloud/check/cloud_material.hpp"

namespace odosplat {

/// Pairs with fewer patches are not used.
inline constexpr std::size_t least_patches = 40;

/// Two images by their numbers; patches of the first are searched in the second.
struct ImagePair {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// At most `wanted` pairs of images `gap` apart, evenly spread. Their images have poses with shifts of 0 and of
/// max_shift in both directions; if there are no such pairs, those that have poses without a shift.
std::vector<ImagePair> choose_pairs(const CloudMaterial& material, int gap, int wanted, int max_shift);

/// The depths given to patches: the cloud's own, or those of a control.
enum class PatchDepths {
  cloud,
  flat,    // all patches of an image at their median depth, facing the camera
  distant  // all patches so far away that the camera's motion does not shift them
};

/// How well patches agree under a reading. world: material.world(reading.mirrored), or a modified copy of it.
CloudRow measure_row(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                     const std::vector<ImagePair>& pairs, const CloudCheckOptions& options,
                     PatchDepths depths = PatchDepths::cloud);

/// The scores with the cloud and with both controls.
CloudControl measure_control(CloudMaterial& material, const PatchWorld& world, const CloudReading& reading,
                             const std::vector<ImagePair>& pairs, const CloudCheckOptions& options);

/// All readings without a shift, then shifts of the best of them and of the declared one; best first. progress: called
/// with the share of the work done; may be empty.
std::vector<CloudRow> measure_readings(CloudMaterial& material, const CloudReading& declared,
                                       const std::vector<ImagePair>& pairs, const CloudCheckOptions& options,
                                       const std::function<void(double)>& progress);

}  // namespace odosplat
