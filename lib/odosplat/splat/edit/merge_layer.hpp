// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "odosplat/splat/edit/merge_options.hpp"
#include "odosplat/splat/map.hpp"

namespace odosplat {

/// The Gaussians of one map, or of maps already merged, as merging looks at them. One value per Gaussian.
struct MergeLayer {
  std::vector<Eigen::Vector3f> points;   // [m, world]
  std::vector<Eigen::Vector3f> normals;  // unit length, either sign
  std::vector<float> spacings;           // [m]
  std::vector<float> sigmas;             // [m] across the surface
  std::vector<float> gray;               // 0..1
  std::vector<char> flat;                // 1: its normal is reliable
  std::vector<char> solid;               // 1: opaque enough to count as surface

  std::size_t size() const { return points.size(); }
  /// The i with keep[i] of `other` at the end.
  void append(const MergeLayer& other, const std::vector<bool>& keep);
};

MergeLayer merge_layer(const Map& map);

/// Which Gaussians of `layer` lie on a surface that the solid Gaussians of `other` with usable[j] hold.
std::vector<bool> covered(const MergeLayer& layer, const MergeLayer& other, const std::vector<bool>& usable,
                          const MergeOptions& options);

/// Compares the surfaces that both hold; searches farther than covered() does.
MergeOverlap compare_surfaces(const MergeLayer& layer, const MergeLayer& other);

/// The patch of every Gaussian of both layers (first those of a): a number from 0. Centres of patches are Gaussians of
/// a and b at least `radius` apart; a Gaussian belongs to the nearest.
struct MergePatches {
  std::vector<int> of_a;
  std::vector<int> of_b;
  std::size_t count = 0;
};
MergePatches merge_patches(const MergeLayer& a, const MergeLayer& b, double radius);

}  // namespace odosplat
