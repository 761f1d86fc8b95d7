// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/map.hpp"

namespace odosplat {

/// The header with one more line, "edit WHAT": what a tool did to the map. Everything else stays, so quality and sigma
/// are those that were measured before. `what` without line breaks.
MapHeader with_edit(const MapHeader& header, const std::string& what);

/// The words of the lines "edit ...", oldest first.
std::vector<std::string> edits_of(const MapHeader& header);

/// A map that goes into another, for its header.
struct HeaderSource {
  std::string name;
  MapHeader header;
  std::size_t gaussians = 0;  // that it has
  std::size_t kept = 0;       // of these in the merged map
};

/// The header of maps put together, with an "edit" line:
/// - sigma: of each factor the largest of the maps (a map that is not calibrated counts with the default model); none
///   if no map is calibrated;
/// - options of rasterisation: those of the first map;
/// - quality: none, since nobody measured it; "doubtful", with the reason, if that of a map is not good;
/// - training views of all, thinned as in training, and the lines of training frames of all;
/// - settings on which all agree stay; others become "source K LINE" of map K, counted from 1, and so do earlier edits;
///   "source K NAME: ..." says what the map was.
MapHeader merged_header(const std::vector<HeaderSource>& sources);

}  // namespace odosplat
