// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "odosplat/synth/content/texture.hpp"
#include "odosplat/synth/render/bvh.hpp"

namespace odosplat {

/// The material of a surface: diffuse, with optional specular reflection.
struct Material {
  int texture = -1;                                // index in the scene; -1: plain
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();  // stored colour 0..1 that the texture is multiplied with
  float emission = 0.0F;                           // emitted radiance, multiplied by the colour (lamps, screens)
  float gloss = 0.0F;                              // 0..1 mirror reflectance at normal incidence (Schlick 1994)
  bool fit = false;                                // true: one tile fills the surface; false: tiles are metric
  bool casts_shadow = true;                        // false: light passes through (lampshades, sheer curtains)
};

/// A part of a scene with its own coordinates (u, v) in [0, 1]^2, on which light is stored as a small image.
struct ScenePatch {
  int material = 0;
  Eigen::Vector2f tiles = Eigen::Vector2f::Ones();        // texture tiles over the patch, in u and v
  Eigen::Vector2f tile_offset = Eigen::Vector2f::Zero();  // [tiles]
  float texels_per_m = 1.0F;                              // of the texture on this patch
  int light_width = 0;                                    // texels of the stored light; 0: unlit, colours unchanged
  int light_height = 0;
  std::vector<Eigen::Vector3f> light;  // irradiance / pi, linear, row by row; texel centres at (i + 0.5) / size
};

struct SceneTriangle {
  Bvh::Triangle p_world;              // [m]
  std::array<Eigen::Vector2f, 3> uv;  // on the patch
  Eigen::Vector3f normal_world;       // of the plane, unit length, towards the front
  int patch = 0;
};

/// The data of a scene, filled by SceneBuilder.
struct SceneContent {
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<Material> materials;
  std::vector<ScenePatch> patches;
  std::vector<SceneTriangle> triangles;
  std::shared_ptr<const Texture> background;  // over azimuth and elevation, for rays that hit nothing; none: black
  float background_radiance = 1.0F;
  float exposure = 1.0F;
  bool lit = false;  // false: surfaces have their own colour, without a tone curve
};

/// A room or other environment: triangles with textures and stored soft light. Metres; the world's z axis points up.
/// Made by SceneBuilder or by the functions of rooms.hpp. Immutable; any number of threads may use it at once.
class Scene {
 public:
  explicit Scene(SceneContent content);

  /// Nearest hit; false if the ray leaves the scene. hint as in Bvh::closest.
  bool closest(const Ray& ray, RayHit& hit, int hint = -1) const { return bvh_.closest(ray, hit, hint); }
  /// As Bvh::closest4.
  void closest4(const std::array<Ray, 4>& rays, std::array<RayHit, 4>& hits, std::array<bool, 4>& found,
                int hint = -1) const {
    bvh_.closest4(rays, hits, found, hint);
  }
  /// Whether the ray hits a surface that casts a shadow.
  bool occluded(const Ray& ray) const { return bvh_.any(ray); }

  /// Ray parameter of the plane of a hit triangle, computed in double precision.
  double plane_parameter(int triangle, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Linear R, G, B radiance from a hit back along the ray. footprint_m: width [m] of the area that one sample
  /// represents.
  Eigen::Vector3f radiance(const Ray& ray, const RayHit& hit, float footprint_m) const;
  /// Linear R, G, B of the background in a direction of any length.
  Eigen::Vector3f background(const Eigen::Vector3f& direction) const;
  /// Diffuse reflectance 0..1, linear R, G, B.
  Eigen::Vector3f albedo(const RayHit& hit, float footprint_m) const;
  /// Stored light (irradiance / pi) at a hit; ones in an unlit scene.
  Eigen::Vector3f light(const RayHit& hit) const;
  /// Radiance to stored colour 0..1: exposure, a soft shoulder (lit scenes), gamma.
  Eigen::Vector3f develop(const Eigen::Vector3f& radiance) const;

  const SceneContent& content() const { return content_; }
  /// Corners of the bounding box [m]; zeros for an empty scene.
  Eigen::Vector3f low() const { return low_; }
  Eigen::Vector3f high() const { return high_; }

 private:
  Eigen::Vector2f patch_uv(const RayHit& hit) const;
  Eigen::Vector3f diffuse(const RayHit& hit, float footprint_m) const;

  SceneContent content_;
  std::vector<Eigen::Vector3f> tints_;  // of the materials, linear
  Bvh bvh_;
  Eigen::Vector3f low_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f high_ = Eigen::Vector3f::Zero();
};

}  // namespace odosplat
