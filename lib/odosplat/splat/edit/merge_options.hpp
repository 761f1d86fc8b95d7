// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>

namespace odosplat {

/// How maps of one frame are put together. "Spacing" is the mean distance of a Gaussian to the six nearest of its map.
/// Sigma of a Gaussian across its surface: its thickness, and the share of its distance from the map's nearest training
/// view that the map's sigma model names (a tenth of the spacing where the map has no training views).
struct MergeOptions {
  double sigmas = 3.0;           // of two Gaussians together: farther apart along the normal they are two surfaces ...
  double spacings = 0.5;         // ... unless they are within this many spacings, below which a map resolves nothing
  double patch_spacings = 8.0;   // radius of the patches of surface in which one map is taken, > 0
  double complete_share = 0.95;  // of the other map's Gaussians in a patch that a map must cover to be complete there
  double better = 1.2;       // ratio of sigma, or of the number of Gaussians, that makes a map better in a patch, >= 1
  double warn_sigmas = 3.0;  // median distance along the normal of the surfaces in common: a warning above this ...
  double most_sigmas = 8.0;  // ... and an InputError above this
  double warn_gray = 0.05;   // median difference of brightness (0..1) of the surfaces in common: likewise
  double most_gray = 0.25;
  bool force = false;  // no InputError for these, nor for maps that are rendered differently: warnings instead

  /// Throws InputError naming the field.
  void check() const;
};

/// How a map agrees with those before it.
struct MergeOverlap {
  std::size_t pairs = 0;    // Gaussians on a surface that both hold
  double distance_m = 0.0;  // median distance along the normals, on the faces (x, y or z) where it is largest in sigmas
  double sigmas = 0.0;      // the same over sigma
  double gray = 0.0;        // median of its brightness minus theirs, 0..1
  // Surfaces that face x, y or z: both have some in the box that holds parts of both, but hardly any is the same.
  std::array<bool, 3> unmet{};
};

}  // namespace odosplat
