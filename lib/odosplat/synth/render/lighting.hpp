// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

/// A diffuse area light: a parallelogram (a window, emitting to the side of edge_v x edge_u) or a sphere of the given
/// radius about corner.
struct Light {
  Eigen::Vector3f corner;
  Eigen::Vector3f edge_u = Eigen::Vector3f::Zero();
  Eigen::Vector3f edge_v = Eigen::Vector3f::Zero();
  float radius = 0.0F;                                 // [m]; > 0: a sphere
  Eigen::Vector3f radiance = Eigen::Vector3f::Ones();  // linear
};

/// Positions [m] and normals of a patch's points in the world frame, and its extent [m].
struct PatchFrame {
  std::function<Eigen::Vector3f(float u, float v)> position;
  std::function<Eigen::Vector3f(float u, float v)> normal;
  Eigen::Vector2f size_m;
};

struct LightingOptions {
  float texel_m = 0.07F;    // [m] distance of the points where light is stored, > 0
  int max_texels = 96;      // per side of a patch, 2..1024
  int light_samples = 16;   // points on each light, 1..4096
  int gather_samples = 36;  // directions for light from other surfaces, 1..4096
  int bounces = 2;          // 0..8
  float exposure = 1.0F;    // factor on the radiance before the tone curve, > 0

  /// Throws InputError naming the field.
  void check() const;
};

/// Computes the light stored on the patches: direct light from area lights with shadow rays, then `bounces` rounds of
/// diffuse light from other surfaces (final gathering by cosine-weighted directions). Rays that leave the scene
/// contribute no light, because windows are area lights. Writes content.patches[i].light for each frames[i],
/// content.lit and content.exposure. Deterministic, whatever the number of threads: sample points are Hammersley points
/// (Hammersley 1960), shifted by a hash of the texel.
void compute_light(SceneContent& content, const std::vector<PatchFrame>& frames, const std::vector<Light>& lights,
                   const LightingOptions& options);

}  // namespace odosplat
