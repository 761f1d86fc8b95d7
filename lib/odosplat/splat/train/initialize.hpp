// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// How the Gaussians of a cloud are shaped before training.
enum class InitialShape {
  discs,  // flat, on the surface: two equal axes in the plane of the normal, the third (its normal) short
  round   // the paper's code: spheres as large as the neighbours' distance, rotated at random
};

struct InitializeOptions {
  InitialShape shape = InitialShape::discs;
  int sh_degree = 1;           // degree of the colours' spherical harmonics, 0..3; coefficients above degree 0 are zero
  float opacity = 0.8F;        // 0..1, both excluded (the paper's value)
  int scale_neighbors = 3;     // a Gaussian's size is the mean distance to this many nearest points, >= 1
  float scale_factor = 0.6F;   // times that distance: standard deviation in the plane, > 0
  float flatness = 0.1F;       // discs: thickness over size, > 0, at most 1
  float largest_scale = 4.0F;  // sizes are held below this many times the median size, >= 1 (stray points)
  int normal_neighbors = 20;   // neighbours of a normal, where the cloud has none, >= 3
  int smoothing_neighbors = 32;  // discs: neighbours that a point is smoothed with along its normal, 0 = none
  std::size_t budget = 0;        // at most this many Gaussians: a seeded random choice of the points; 0 = all of them
  std::uint64_t seed = 42;

  /// "default", or "paper": spheres as large as the neighbours' distance. Throws InputError else.
  static InitializeOptions preset(const std::string& name);
  /// Throws InputError naming the field.
  void check() const;
};

/// The cloud as discs are made from it: with normals (its own, or estimated) and with points moved along them to the
/// weighted mean of those neighbours whose normals agree, which takes out much of the scanner's noise and keeps edges
/// (Fleishman et al. 2003, bilateral mesh denoising, on points). Errors as of gaussians_from_cloud.
PointCloud smoothed_cloud(const PointCloud& cloud, const InitializeOptions& options);

/// Standard deviation [m] of the noise that smoothing left in the points, along their normals: what map and surface
/// have in common and a comparison of the two does not show. From how far points moved (robustly), divided by the root
/// of the number of neighbours that a point was averaged with. The cloud before and after, point by point.
double noise_left(const PointCloud& cloud, const PointCloud& smoothed, const InitializeOptions& options);

/// One Gaussian per point: the start of training.
/// Source: the paper's section on map training (a Gaussian a point, opacity 0.8), Kerbl et al. 2023 (size from the
/// three nearest neighbours). Differs: by default flat discs on the cloud's normals, because depth of round Gaussians
/// lies up to one standard deviation before the surface; and points are smoothed first (smoothed_cloud). Positions in
/// the cloud's world frame [m]. Axis 2 of a disc is its normal. Colours 0..1 go to the SH term of degree 0; a cloud
/// without colours becomes grey (discs) or random (round). Throws InputError for an empty cloud, for points that are
/// not finite, and for bad options. Deterministic for a seed.
Gaussians gaussians_from_cloud(const PointCloud& cloud, const InitializeOptions& options);

}  // namespace odosplat
