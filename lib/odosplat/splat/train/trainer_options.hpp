// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/train/adam.hpp"
#include "odosplat/splat/train/densify.hpp"
#include "odosplat/splat/train/depth_loss.hpp"
#include "odosplat/splat/train/exposures.hpp"
#include "odosplat/splat/train/losses.hpp"
#include "odosplat/splat/train/surface_terms.hpp"

namespace odosplat {

/// What lengths of position steps are measured in.
enum class PositionLength {
  gaussian_size,  // median size (longest standard deviation) of the Gaussians at the start
  camera_extent   // largest distance of a camera from the cameras' mean (Kerbl et al. 2023)
};

struct TrainerOptions {
  int iterations = 2000;  // steps, one image each, >= 0
  std::uint64_t seed = 42;
  int coarse_levels = 1;      // image levels, each half the size, that training starts on, 0..4; 0: full size only
  float coarse_share = 0.2F;  // share of the iterations on levels above 0, split evenly, 0..1
  int sh_interval = 400;      // steps from one degree of spherical harmonics to the next, >= 0; 0: all from the start

  PositionLength position_length = PositionLength::gaussian_size;
  // Adam rates per step, at the start. Those without a unit are of the attribute as it is stored.
  double position_rate = 5e-3;        // [position lengths]
  double position_rate_final = 5e-5;  // [position lengths] reached log-linearly at the last step
  double scale_rate = 5e-3;           // of log scales
  double rotation_rate = 1e-3;        // of quaternions; normal_weight keeps discs from tilting towards the camera
  double opacity_rate = 2e-2;         // of opacity logits
  double color_rate = 1e-2;           // of SH of degree 0
  double sh_rate = 5e-4;              // of the other SH
  double final_share = 0.1;           // all rates but that of positions fall log-linearly to this share of their start,
                                      // 0..1
  bool keep_thickness = true;         // the third axis (of discs: across the surface) is left as it is

  double largest_growth = 3.0;  // no axis grows beyond this many times its start, as it would at silhouettes, >= 1; 0:
                                // no limit

  LossOptions loss;
  DepthLossOptions depth;       // used where the trainer is given a surface
  SurfaceTermsOptions surface;  // for Gaussians that start as discs
  ExposureOptions exposure;
  DensifyOptions densify;
  std::size_t depth_cache_mb = 512;  // most memory for target depth; beyond, it is rendered again in every round

  AdamOptions adam;
  RasterizerOptions rasterizer{.order = BlendOrder::distance};

  /// views: number of images; many images get more iterations, 0 gets the least number.
  /// "default": depth is kept while colours are trained. "paper": the public recipe of the paper's code (rates of
  /// GS-DSO's fork of OpenSplat, 20 000 steps, levels /4, /2, 1, no decay but of positions, no depth, clone and split,
  /// opacity resets). Throws InputError else.
  static TrainerOptions preset(const std::string& name, int views = 0);
  /// Throws InputError naming the field.
  void check() const;
  /// One line "name value" per setting, for the header of the map.
  std::vector<std::string> describe() const;
};

}  // namespace odosplat
