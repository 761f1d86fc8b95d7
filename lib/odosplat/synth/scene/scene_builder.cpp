// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/scene/scene_builder.hpp"

#include <cmath>
#include <utility>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {

int SceneBuilder::add_texture(const ColorImage& image, const Eigen::Vector2f& size_m, Texture::Edge edge) {
  content_.textures.push_back(std::make_shared<const Texture>(image, size_m, edge));
  return static_cast<int>(content_.textures.size()) - 1;
}

int SceneBuilder::add_material(const Material& material) {
  require(material.texture >= -1 && material.texture < static_cast<int>(content_.textures.size()), "material.texture",
          "the index of a texture");
  content_.materials.push_back(material);
  return static_cast<int>(content_.materials.size()) - 1;
}

int SceneBuilder::add_plain(float red, float green, float blue) {
  Material material;
  material.tint = {red, green, blue};
  return add_material(material);
}

void SceneBuilder::set_background(const ColorImage& image, float radiance) {
  content_.background = std::make_shared<const Texture>(image, Eigen::Vector2f(1.0F, 1.0F), Texture::Edge::repeat);
  content_.background_radiance = radiance;
}

void SceneBuilder::add_surface(const Surface& surface) {
  require(surface.material >= 0 && surface.material < static_cast<int>(content_.materials.size()), "surface.material",
          "the index of a material");
  require(surface.segments_u >= 1 && surface.segments_v >= 1, "surface.segments", "at least 1");
  require(surface.size_m.minCoeff() > 0.0F, "surface.size_m", "positive");
  ScenePatch patch;
  patch.material = surface.material;
  const Material& material = content_.materials[static_cast<std::size_t>(surface.material)];
  if (material.texture >= 0) {
    const Texture& texture = *content_.textures[static_cast<std::size_t>(material.texture)];
    const Eigen::Vector2f tile_m = material.fit ? surface.size_m : texture.size_m();
    patch.tiles = surface.size_m.cwiseQuotient(tile_m);
    patch.tile_offset = surface.texture_offset_m.cwiseQuotient(tile_m);
    patch.texels_per_m = std::sqrt(texture.texels().cwiseQuotient(tile_m).prod());
  }
  const int patch_index = static_cast<int>(content_.patches.size());
  content_.patches.push_back(patch);

  const Eigen::Isometry3f T_world_local = T_world_local_;
  frames_.push_back({[T_world_local, position = surface.position](float u, float v) -> Eigen::Vector3f {
                       return T_world_local * position(u, v);
                     },
                     [T_world_local, normal = surface.normal](float u, float v) -> Eigen::Vector3f {
                       return T_world_local.linear() * normal(u, v);
                     },
                     surface.size_m});
  const PatchFrame& frame = frames_.back();
  auto add_triangle = [&](const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
    SceneTriangle triangle;
    triangle.uv = {a, b, c};
    for (std::size_t i = 0; i < 3; ++i) triangle.p_world[i] = frame.position(triangle.uv[i].x(), triangle.uv[i].y());
    const auto& p = triangle.p_world;
    const Eigen::Vector3f normal = (p[2] - p[0]).cross(p[1] - p[0]);
    if (normal.norm() < 1e-12F) return;  // degenerate triangle at the pole of a closed surface
    triangle.normal_world = normal.normalized();
    triangle.patch = patch_index;
    content_.triangles.push_back(triangle);
  };
  for (int j = 0; j < surface.segments_v; ++j) {
    for (int i = 0; i < surface.segments_u; ++i) {
      const float u0 = static_cast<float>(i) / static_cast<float>(surface.segments_u);
      const float u1 = static_cast<float>(i + 1) / static_cast<float>(surface.segments_u);
      const float v0 = static_cast<float>(j) / static_cast<float>(surface.segments_v);
      const float v1 = static_cast<float>(j + 1) / static_cast<float>(surface.segments_v);
      add_triangle({u0, v0}, {u1, v0}, {u1, v1});
      add_triangle({u0, v0}, {u1, v1}, {u0, v1});
    }
  }
}

void SceneBuilder::add_quad(const Eigen::Vector3f& corner, const Eigen::Vector3f& edge_u, const Eigen::Vector3f& edge_v,
                            int material, const Eigen::Vector2f& texture_offset_m) {
  const Eigen::Vector3f normal = edge_v.cross(edge_u).normalized();
  Surface surface;
  surface.position = [=](float u, float v) -> Eigen::Vector3f { return corner + u * edge_u + v * edge_v; };
  surface.normal = [=](float, float) { return Eigen::Vector3f(normal); };
  surface.size_m = {edge_u.norm(), edge_v.norm()};
  surface.material = material;
  surface.texture_offset_m = texture_offset_m;
  add_surface(surface);
}

void SceneBuilder::add_box(const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                           const std::array<int, 6>& materials) {
  const Eigen::Vector3f size = high - low;
  const Eigen::Vector3f dx(size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f dy(0.0F, size.y(), 0.0F);
  const Eigen::Vector3f dz(0.0F, 0.0F, size.z());
  auto face = [&](std::size_t i, const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
    if (materials[i] >= 0) add_quad(corner, u, v, materials[i]);
  };
  face(0, low + dy + dz, -dy, -dz);
  face(1, low + dx + dz, dy, -dz);
  face(2, low + dz, dx, -dz);
  face(3, high, -dx, -dz);
  face(4, low, dx, dy);
  face(5, low + dy + dz, dx, -dy);
}

void SceneBuilder::add_box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, int material) {
  add_box(low, high, {material, material, material, material, material, material});
}

void SceneBuilder::add_cylinder(const Eigen::Vector3f& base, const Eigen::Vector3f& top, float radius_base,
                                float radius_top, int material, int segments, bool caps) {
  const Eigen::Vector3f axis = (top - base).normalized();
  const Eigen::Vector3f helper = std::abs(axis.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f s = helper.cross(axis).normalized();
  const Eigen::Vector3f t = axis.cross(s);
  auto outward = [=](float u) -> Eigen::Vector3f {
    return std::cos(2.0F * float_pi * u) * s + std::sin(2.0F * float_pi * u) * t;
  };
  const float length = (top - base).norm();
  const float slope = (radius_base - radius_top) / length;
  Surface side;
  side.position = [=](float u, float v) -> Eigen::Vector3f {
    return top + v * (base - top) + (radius_top + v * (radius_base - radius_top)) * outward(u);
  };
  side.normal = [=](float u, float) -> Eigen::Vector3f { return (outward(u) + slope * axis).normalized(); };
  side.segments_u = segments;
  side.size_m = {float_pi * (radius_base + radius_top), length};
  side.material = material;
  add_surface(side);
  if (!caps) return;
  auto disc = [&](const Eigen::Vector3f& centre, float radius, float sign) {
    if (radius <= 0.0F) return;
    Surface cap;
    cap.position = [=](float u, float v) -> Eigen::Vector3f { return centre + radius * v * outward(sign * u); };
    cap.normal = [=](float, float) -> Eigen::Vector3f { return sign * axis; };
    cap.segments_u = segments;
    cap.size_m = {2.0F * float_pi * radius, radius};
    cap.material = material;
    add_surface(cap);
  };
  disc(top, radius_top, 1.0F);
  disc(base, radius_base, -1.0F);
}

void SceneBuilder::add_cushion(const Eigen::Vector3f& centre, const Eigen::Vector3f& radii, float exponent,
                               int material, int segments) {
  require(exponent > 0.0F && exponent <= 1.0F, "cushion exponent", "in (0, 1]");
  const float n = 2.0F / exponent;
  // Six faces of a cube (corner and edges as in add_box), projected onto |x|^n + |y|^n + |z|^n = 1.
  struct Face {
    Eigen::Vector3f corner, edge_u, edge_v;
  };
  const std::array<Face, 6> faces{Face{{-1, 1, 1}, {0, -2, 0}, {0, 0, -2}}, Face{{1, -1, 1}, {0, 2, 0}, {0, 0, -2}},
                                  Face{{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}}, Face{{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}},
                                  Face{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}}, Face{{-1, 1, 1}, {2, 0, 0}, {0, -2, 0}}};
  for (const Face& face : faces) {
    auto on_unit = [face, n](float u, float v) -> Eigen::Vector3f {
      const Eigen::Vector3f cube = face.corner + u * face.edge_u + v * face.edge_v;
      return cube / std::pow(cube.array().abs().pow(n).sum(), 1.0F / n);
    };
    Surface surface;
    surface.position = [=](float u, float v) -> Eigen::Vector3f { return centre + radii.cwiseProduct(on_unit(u, v)); };
    surface.normal = [=](float u, float v) -> Eigen::Vector3f {
      const Eigen::Vector3f p = on_unit(u, v);
      const Eigen::Array3f slope = p.array().sign() * p.array().abs().pow(n - 1.0F) / radii.array();
      return slope.matrix().normalized();
    };
    surface.segments_u = surface.segments_v = segments;
    surface.size_m = {face.edge_u.cwiseProduct(radii).norm(), face.edge_v.cwiseProduct(radii).norm()};
    surface.material = material;
    add_surface(surface);
  }
}

void SceneBuilder::add_window_light(const Eigen::Vector3f& corner, const Eigen::Vector3f& edge_u,
                                    const Eigen::Vector3f& edge_v, const Eigen::Vector3f& radiance) {
  const Eigen::Matrix3f R = T_world_local_.linear();
  lights_.push_back({T_world_local_ * corner, R * edge_u, R * edge_v, 0.0F, radiance});
}

void SceneBuilder::add_lamp(const Eigen::Vector3f& centre, float radius, const Eigen::Vector3f& radiance) {
  require(radius > 0.0F, "lamp radius", "positive");
  lights_.push_back({T_world_local_ * centre, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), radius, radiance});
}

Scene SceneBuilder::build_unlit() const { return Scene(content_); }

Scene SceneBuilder::build(const LightingOptions& options) const {
  SceneContent content = content_;
  compute_light(content, frames_, lights_, options);
  return Scene(std::move(content));
}

}  // namespace odosplat
