// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/quality/color_consistency.hpp"
#include "odosplat/splat/quality/map_verdict.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/train/exposures.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

/// A trained map at one of its training views.
struct ViewQuality {
  double psnr_db = 0.0;
  double depth_error_m = -1.0;      // median of |rendered - the cloud's| [m], negative: no pixel has both
  double depth_error_share = -1.0;  // the same over the depth
  double covered = 0.0;             // share of the pixels with depth, 0..1
  bool odd = false;                 // disagrees with the rest (mark_odd)
};

/// How the training went that made a map.
struct TrainingEvidence {
  int iterations = -1;        // that were done, negative: unknown
  int usual_iterations = 0;   // of the preset
  std::size_t gaussians = 0;  // of the map
  std::size_t points = 0;     // of the cloud
  std::size_t budget = 0;     // most Gaussians that the user asked for, 0: no such limit
};

/// From samples of at most 200 views and 100 000 points, evenly spread. Uses all threads; deterministic.
CloudCoverage cloud_coverage(const PointCloud& cloud, const TrainingViews& views);

/// Whether a point of the cloud is in any image, hidden or not; inverted: if the poses were T_camera_world.
bool any_in_view(const PointCloud& cloud, const TrainingViews& views, bool inverted = false);

/// Every training view against its image, and against the depth of `surface` (null: unknown), in the order of the
/// views. exposures: those trained with the map.
std::vector<ViewQuality> view_qualities(const compute::Context& context, const Gaussians& gaussians,
                                        TrainingViews& views, MapView* surface, const Exposures& exposures,
                                        const RasterizerOptions& options);

/// Marks the views whose PSNR is lower, or whose depth error is larger, than the median by more than five robust
/// standard deviations (1.4826 median absolute deviations) and at least by 4 dB or a factor of 3.
void mark_odd(std::vector<ViewQuality>& views);

/// The verdict from all of that, and from the result of geometry_doubt. A map is not judged, and does not count as
/// good, if it was not trained, or on one or two images only, which a map can fit with any geometry. A likely cause of
/// doubt is named only if there is evidence for it: a geometry that fits better, images that do not agree on the
/// cloud's colours, a training that was much shorter than the preset's or was held to a budget below the cloud's
/// points, images that disagree with the rest.
MapQuality judge_map(const std::vector<ViewQuality>& views, const CloudCoverage& coverage, double consistency,
                     const std::optional<GeometryDoubt>& doubt, const TrainingEvidence& training = {});

}  // namespace odosplat
