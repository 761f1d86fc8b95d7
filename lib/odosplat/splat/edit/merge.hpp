// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "odosplat/splat/map.hpp"

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

/// A map, and what messages and the merged header call it.
struct MergeSource {
  std::string name;
  Map map;
};

/// How a map agrees with those before it.
struct MergeOverlap {
  std::size_t pairs = 0;    // Gaussians on a surface that both hold
  double distance_m = 0.0;  // median distance along the normals, on the faces (x, y or z) where it is largest in sigmas
  double sigmas = 0.0;      // the same over sigma
  double gray = 0.0;        // median of its brightness minus theirs, 0..1
};

struct MergedMap {
  Map map;
  std::vector<std::size_t> kept;       // Gaussians of each source
  std::vector<MergeOverlap> overlaps;  // of sources 1, 2, ... with those before
  std::vector<std::string> warnings;   // one line each
};

/// Puts maps of one world frame together so that no surface is doubled. Maps are added in their order. Where a map and
/// those before hold the same surface (Gaussians within `sigmas` or `spacings` of each other along the normal, normals
/// within 45 degrees, among each other's neighbours), space is divided into patches around points of the surfaces, and
/// in each patch one of the two is taken: the complete one, else that with the smaller sigma, else the denser, else the
/// earlier. A Gaussian of the other one is dropped only if Gaussians that are kept cover it: what only one map holds
/// stays, and the seam has no gap. Gaussians are not changed and keep their order; spherical harmonics get the highest
/// degree. Header: merged_header.
/// Throws InputError "NAME: fault" for fewer than two maps, for one without Gaussians, for maps that are rendered with
/// different options (order of blending, dilation, compensation), and for maps that disagree (see options). Maps
/// without a surface in common are merged with a warning. Uses all threads; bit-identical for any number of threads.
/// notice: called before each map; may throw to stop.
MergedMap merge_maps(const std::vector<MergeSource>& sources, const MergeOptions& options = {},
                     const std::function<void(const std::string& name)>& notice = {});

}  // namespace odosplat
