// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/quality/map_verdict.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/sigma_model.hpp"

namespace odosplat {

/// The data of a map besides its Gaussians. The other fields are read from the notes, and write_map writes only the
/// notes: to change a field, change the notes and make the header anew (from_notes). Defaults: those of a map without
/// such notes (trained elsewhere, or .splat).
struct MapHeader {
  /// The lines of the file's header: settings of the training, and everything below; or the comments of another
  /// program's PLY, without those that begin with the name of a setting of ours.
  std::vector<std::string> notes;
  /// What the Gaussians are to be rendered with: the order in which they are blended ("blend_order"; depth where it is
  /// not said), "dilation" and "compensated".
  RasterizerOptions rasterizer;
  /// The uncertainty of its depth ("sigma_..."); none: it was not calibrated.
  std::optional<SigmaModel> sigma;
  /// T_world_camera from which its training images were taken, thinned ("training_view ...").
  std::vector<SE3> places;
  /// The quality that training found ("quality_..."); none: unknown.
  std::optional<MapQuality> quality;

  /// From notes. InputError("field", fault) for what check_map_header refuses.
  static MapHeader from_notes(std::vector<std::string> notes);
};

/// A trained map as its file holds it.
struct Map {
  Gaussians gaussians;
  MapHeader header;
};

}  // namespace odosplat
