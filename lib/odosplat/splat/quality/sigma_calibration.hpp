// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/compute/context.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/sigma_model.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat {

struct SigmaCalibrationOptions {
  int views = 40;             // at most this many of the training views, evenly spread, >= 1
  int samples = 2000;         // pixels a view, >= 1: of a grid's cells the one with the strongest image gradient
  double shared_sigma = 0.0;  // [m] error across the surface that map and surface have in common (noise_left), >= 0
  RasterizerOptions rasterizer;

  void check() const;
};

/// One pixel: the error of the map's depth, and what sigma can be made of.
struct SigmaSample {
  double error = 0.0;         // [m] map - measured; it contains the measurement's own error, which makes sigma a little
                              // too large
  double shared_sigma = 0.0;  // [m] along the ray: error that map and surface have in common
  double spread = 0.0;        // [m]
  double slope = 0.0;         // [m/px]
  double depth = 0.0;         // [m]
  double open = 0.0;          // 1 - alpha
};

/// Factors for which 95.4 % of the errors are within two sigmas, as of a normal distribution, for all kinds of pixels:
/// quantile regression (Koenker and Bassett 1978) of ln |error| on ln 2 sigma, searched factor by factor on a
/// logarithmic grid. Errors of depth are not normally distributed: most are small, and where two surfaces meet some are
/// as large as the gap. A variance would be determined by those few, and a variance without them would make such pixels
/// seem certain. least: lower bounds of the factors. Without samples the defaults. Deterministic.
SigmaModel fit_sigma(const std::vector<SigmaSample>& samples, const SigmaModel& least);

/// Fits the factors to the map's depth (mode surface) at training views, compared with the depth measured there, or
/// without that, with the surface that the map was made from. The surface is not reliable near its edges, where the
/// spread counts, and does not show errors that it has in common with the map: if it is used, the spread keeps at least
/// half its weight, and shared_sigma is added. Only pixels with an image gradient are compared, as trackers use those.
SigmaModel calibrated_sigma(const compute::Context& context, const Gaussians& gaussians, TrainingViews& views,
                            MapView& surface, const SigmaCalibrationOptions& options = {});

}  // namespace odosplat
