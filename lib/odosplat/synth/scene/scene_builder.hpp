// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

#include "odosplat/synth/render/lighting.hpp"
#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

/// Builds scenes from parametric surfaces. Lengths in metres. Everything is added in the local frame set by place().
/// Normals point to the side from which a surface is lit and should be viewed; viewed from there, u runs to the right
/// and v down, as in images. Throws InputError for an index or a size out of range. Not thread safe.
class SceneBuilder {
 public:
  /// A surface over (u, v) in [0, 1]^2, cut into segments_u x segments_v cells of two triangles each.
  struct Surface {
    std::function<Eigen::Vector3f(float u, float v)> position;  // local [m]
    std::function<Eigen::Vector3f(float u, float v)> normal;    // local, unit length; used for light only
    int segments_u = 1;
    int segments_v = 1;
    Eigen::Vector2f size_m = Eigen::Vector2f::Ones();  // approximate extent of the surface in u and v
    int material = 0;
    Eigen::Vector2f texture_offset_m = Eigen::Vector2f::Zero();
  };

  int add_texture(const ColorImage& image, const Eigen::Vector2f& size_m, Texture::Edge edge = Texture::Edge::repeat);
  int add_material(const Material& material);
  /// Plain material of a stored colour.
  int add_plain(float red, float green, float blue);
  /// The background where there is no surface: image over azimuth (columns) and elevation (rows, top is up).
  void set_background(const ColorImage& image, float radiance);

  /// Frame of everything added from now on.
  void place(const Eigen::Isometry3f& T_world_local) { T_world_local_ = T_world_local; }

  void add_surface(const Surface& surface);
  /// Normal: edge_v x edge_u.
  void add_quad(const Eigen::Vector3f& corner, const Eigen::Vector3f& edge_u, const Eigen::Vector3f& edge_v,
                int material, const Eigen::Vector2f& texture_offset_m = Eigen::Vector2f::Zero());
  /// Axis-parallel box; materials of the faces -x, +x, -y, +y, -z (bottom), +z (top); a negative one leaves a face out.
  void add_box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const std::array<int, 6>& materials);
  void add_box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, int material);
  /// Truncated cone from `base` (radius_base) to `top` (radius_top), optionally with caps.
  void add_cylinder(const Eigen::Vector3f& base, const Eigen::Vector3f& top, float radius_base, float radius_top,
                    int material, int segments, bool caps);
  /// Superellipsoid |x/a|^(2/e) + |y/b|^(2/e) + |z/c|^(2/e) = 1 (Barr 1981) with exponent e in (0, 1]: 1 gives an
  /// ellipsoid, small values a box with rounded edges. Six faces of segments x segments cells, each with metric texture
  /// coordinates.
  void add_cushion(const Eigen::Vector3f& centre, const Eigen::Vector3f& radii, float exponent, int material,
                   int segments);

  /// Lights, in the local frame.
  void add_window_light(const Eigen::Vector3f& corner, const Eigen::Vector3f& edge_u, const Eigen::Vector3f& edge_v,
                        const Eigen::Vector3f& radiance);
  void add_lamp(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& radiance);

  /// The scene without light, with surfaces in their own colours.
  Scene build_unlit() const;
  /// The scene with light computed and stored (see compute_light).
  Scene build(const LightingOptions& options) const;

 private:
  Eigen::Isometry3f T_world_local_ = Eigen::Isometry3f::Identity();
  SceneContent content_;
  std::vector<PatchFrame> frames_;
  std::vector<Light> lights_;
};

}  // namespace odosplat
