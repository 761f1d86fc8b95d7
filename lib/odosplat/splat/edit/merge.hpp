// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "odosplat/splat/edit/merge_options.hpp"
#include "odosplat/splat/map.hpp"

namespace odosplat {

/// A map, and what messages and the merged header call it.
struct MergeSource {
  std::string name;
  Map map;
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
