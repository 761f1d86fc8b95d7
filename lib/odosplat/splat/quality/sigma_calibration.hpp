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

/// One pixel: what the map says, what the surface says, and what sigma could be made of.
struct SigmaSample {
  double error = 0.0;         // [m] map - measured; the measurement's own part in it makes sigma a little too large
  double shared_sigma = 0.0;  // [m] along the ray, of both
  double spread = 0.0;        // [m]
  double slope = 0.0;         // [m/px]
  double depth = 0.0;         // [m]
  double open = 0.0;          // 1 - alpha
};

/// Factors for which 95.4 % of the errors are within two sigmas, as a normal distribution's are, whatever the pixel is
/// like: quantile regression (Koenker and Bassett 1978) of ln |error| on ln 2 sigma, searched factor by factor on a
/// logarithmic grid. Errors of depth are not normal: most are small, and where two surfaces meet some are as large as
/// the gap. A variance would hang on those few, and one that leaves them out calls such pixels sure.
/// least: factors are not below these. Without samples the defaults. Deterministic.
SigmaModel fit_sigma(const std::vector<SigmaSample>& samples, const SigmaModel& least);

/// The map's depth (mode surface) at training views against the depth measured there, or where there is none, against
/// the surface it was made from, and the factors of that. The surface says nothing near its edges, where the spread
/// counts, nor of what it has in common with the map: with it alone the spread keeps at least half its weight, and
/// shared_sigma is added. Pixels with an image gradient are what trackers use, so those are judged.
SigmaModel calibrated_sigma(const compute::Context& context, const Gaussians& gaussians, TrainingViews& views,
                            MapView& surface, const SigmaCalibrationOptions& options = {});

}  // namespace odosplat
