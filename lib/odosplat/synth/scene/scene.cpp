// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"

namespace odosplat {

Scene::Scene(SceneContent content) : content_(std::move(content)) {
  std::vector<Bvh::Triangle> triangles;
  std::vector<char> opaque;
  triangles.reserve(content_.triangles.size());
  opaque.reserve(content_.triangles.size());
  for (const SceneTriangle& t : content_.triangles) {
    triangles.push_back(t.p_world);
    const int material = content_.patches[static_cast<std::size_t>(t.patch)].material;
    opaque.push_back(content_.materials[static_cast<std::size_t>(material)].casts_shadow ? 1 : 0);
  }
  for (const Material& m : content_.materials) {
    tints_.emplace_back(to_linear(m.tint.x()), to_linear(m.tint.y()), to_linear(m.tint.z()));
  }
  bvh_ = Bvh(triangles, opaque);
  if (triangles.empty()) return;
  low_ = high_ = triangles[0][0];
  for (const Bvh::Triangle& t : triangles) {
    for (const Eigen::Vector3f& p : t) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
  }
}

double Scene::plane_parameter(int triangle, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  const Bvh::Triangle& p = content_.triangles[static_cast<std::size_t>(triangle)].p_world;
  const Eigen::Vector3d p0 = p[0].cast<double>();
  const Eigen::Vector3d normal = (p[1].cast<double>() - p0).cross(p[2].cast<double>() - p0);
  return normal.dot(p0 - origin) / normal.dot(direction);
}

Eigen::Vector2f Scene::patch_uv(const RayHit& hit) const {
  const auto& uv = content_.triangles[static_cast<std::size_t>(hit.triangle)].uv;
  return uv[0] + hit.u * (uv[1] - uv[0]) + hit.v * (uv[2] - uv[0]);
}

Eigen::Vector3f Scene::albedo(const RayHit& hit, float footprint_m) const {
  const int patch_index = content_.triangles[static_cast<std::size_t>(hit.triangle)].patch;
  const ScenePatch& patch = content_.patches[static_cast<std::size_t>(patch_index)];
  const Material& material = content_.materials[static_cast<std::size_t>(patch.material)];
  const Eigen::Vector3f& tint = tints_[static_cast<std::size_t>(patch.material)];
  if (material.texture < 0) return tint;
  const Eigen::Vector2f tile = patch_uv(hit).cwiseProduct(patch.tiles) + patch.tile_offset;
  const Texture& texture = *content_.textures[static_cast<std::size_t>(material.texture)];
  return texture.sample(tile, footprint_m * patch.texels_per_m).cwiseProduct(tint);
}

Eigen::Vector3f Scene::light(const RayHit& hit) const {
  const int patch_index = content_.triangles[static_cast<std::size_t>(hit.triangle)].patch;
  const ScenePatch& patch = content_.patches[static_cast<std::size_t>(patch_index)];
  if (patch.light_width == 0) return Eigen::Vector3f::Ones();
  const Eigen::Vector2f uv = patch_uv(hit);
  const auto last_x = static_cast<float>(patch.light_width - 1);
  const auto last_y = static_cast<float>(patch.light_height - 1);
  const float x = std::clamp(uv.x() * static_cast<float>(patch.light_width) - 0.5F, 0.0F, last_x);
  const float y = std::clamp(uv.y() * static_cast<float>(patch.light_height) - 0.5F, 0.0F, last_y);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, patch.light_width - 1);
  const int y1 = std::min(y0 + 1, patch.light_height - 1);
  const float a = x - static_cast<float>(x0);
  const float b = y - static_cast<float>(y0);
  auto texel = [&](int tx, int ty) -> const Eigen::Vector3f& {
    return patch.light[static_cast<std::size_t>(ty) * static_cast<std::size_t>(patch.light_width) +
                       static_cast<std::size_t>(tx)];
  };
  return (1.0F - b) * ((1.0F - a) * texel(x0, y0) + a * texel(x1, y0)) +
         b * ((1.0F - a) * texel(x0, y1) + a * texel(x1, y1));
}

Eigen::Vector3f Scene::diffuse(const RayHit& hit, float footprint_m) const {
  const int patch = content_.triangles[static_cast<std::size_t>(hit.triangle)].patch;
  const int material = content_.patches[static_cast<std::size_t>(patch)].material;
  const float emission = content_.materials[static_cast<std::size_t>(material)].emission;
  const Eigen::Vector3f incoming = light(hit) + Eigen::Vector3f::Constant(emission);
  return albedo(hit, footprint_m).cwiseProduct(incoming);
}

Eigen::Vector3f Scene::radiance(const Ray& ray, const RayHit& hit, float footprint_m) const {
  const SceneTriangle& triangle = content_.triangles[static_cast<std::size_t>(hit.triangle)];
  const int material = content_.patches[static_cast<std::size_t>(triangle.patch)].material;
  const float gloss = content_.materials[static_cast<std::size_t>(material)].gloss;
  Eigen::Vector3f color = diffuse(hit, footprint_m);
  if (gloss <= 0.0F || !content_.lit) return color;
  const Eigen::Vector3f direction = ray.direction.normalized();
  const float cosine = direction.dot(triangle.normal_world);
  const Eigen::Vector3f mirrored = direction - 2.0F * cosine * triangle.normal_world;
  const float grazing = 1.0F - std::abs(cosine);
  const float share = gloss + (1.0F - gloss) * std::pow(grazing, 5.0F);
  constexpr float offset = 1e-3F;  // [m] so that the reflected ray does not hit its own surface
  const Eigen::Vector3f origin = ray.origin + hit.t * ray.direction + offset * mirrored;
  RayHit other;
  const Ray second{origin, mirrored};
  const Eigen::Vector3f seen = closest(second, other) ? diffuse(other, 2.0F * footprint_m) : background(mirrored);
  return (1.0F - share) * color + share * seen;
}

Eigen::Vector3f Scene::background(const Eigen::Vector3f& direction) const {
  if (!content_.background) return Eigen::Vector3f::Zero();
  const float azimuth = std::atan2(direction.y(), direction.x());
  const float elevation = std::atan2(direction.z(), direction.head<2>().norm());
  const Eigen::Vector2f tile(azimuth / (2.0F * float_pi) + 0.5F, 0.5F - elevation / float_pi);
  return content_.background_radiance * content_.background->sample(tile, 1.0F);
}

Eigen::Vector3f Scene::develop(const Eigen::Vector3f& radiance) const {
  Eigen::Vector3f color;
  for (int c = 0; c < 3; ++c) {
    const float exposed = content_.exposure * radiance[c];
    color[c] = from_linear(content_.lit ? 1.0F - std::exp(-exposed) : std::min(exposed, 1.0F));
  }
  return color;
}

}  // namespace odosplat
