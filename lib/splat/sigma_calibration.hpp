// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/compute/context.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/rasterizer.hpp"
#include "odosplat/splat/sigma_model.hpp"
#include "odosplat/splat/training_targets.hpp"

namespace odosplat {

struct SigmaCalibrationOptions {
  int views = 40;             // at most this many of the training views, evenly spread, >= 1
  int samples = 2000;         // pixels a view, on a grid, >= 1
  double clip = 3.0;          // normalised errors beyond count as this: other surfaces, not noise, > 1
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

/// Factors for which errors over sigma have unit variance: those under which the errors are most likely (normal,
/// normalised errors clipped), searched factor by factor on a logarithmic grid, then
/// all scaled together so that the mean square of the clipped normalised errors is what a normal distribution clipped
/// there has. least: factors are not below these. Without samples the defaults. Deterministic.
SigmaModel fit_sigma(const std::vector<SigmaSample>& samples, double clip, const SigmaModel& least);

/// The map's depth (mode surface) at training views against the depth measured there, or where there is none, against
/// the surface it was made from, and the factors of that. The surface says nothing near its edges, where the spread
/// counts, nor of what it has in common with the map: with it alone the spread keeps at least half its weight, and
/// shared_sigma is added.
SigmaModel calibrated_sigma(const compute::Context& context, const Gaussians& gaussians, TrainingViews& views,
                            MapView& surface, const SigmaCalibrationOptions& options = {});

}  // namespace odosplat
