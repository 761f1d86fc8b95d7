// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

/// A rotating scanner at a fixed position: `rings` beams between two elevations, measured at `columns` azimuths.
struct LidarOptions {
  int rings = 180;               // 1..4096
  int columns = 720;             // 1..16384, over the full circle
  double elevation_min = -1.05;  // [rad] above the scanner's xy plane, -pi/2..pi/2
  double elevation_max = 1.05;   // [rad] >= elevation_min
  double range_min = 0.3;        // [m] > 0; nearer surfaces give no point
  double range_max = 30.0;       // [m] > range_min
  double range_noise = 0.006;    // [m] standard deviation along the beam, 0..0.5
  double min_incidence = 0.06;   // cosine between beam and normal below which there is no return, 0..1
  bool colors = true;            // points have the scene's colour, as seen by a camera at the scanner
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Scans the scene from each pose and merges the points in the world frame [m], scan by scan, ring by ring. Scanner
/// frame: x forward (azimuth 0), y left, z up. Range noise is normal and independent for each beam. There are no points
/// on occluded surfaces, nor for beams that leave the scene (windows). There are no normals, as scanners give none.
/// Without poses the cloud is empty. Deterministic in the seed, whatever the number of threads. Reentrant.
PointCloud simulate_lidar(const Scene& scene, const std::vector<SE3>& T_world_scanner, const LidarOptions& options);

}  // namespace odosplat
