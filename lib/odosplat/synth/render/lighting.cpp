// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/lighting.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/content/noise.hpp"

namespace odosplat {
namespace {

constexpr float nearest = 0.05F;      // [m] lower limit for the distance of a light, so that its light is bounded
constexpr float lift = 2e-3F;         // [m] height above the surface at which light is gathered
constexpr float gather_limit = 2.0F;  // limit for stored light, because bright spots near a lamp would cause speckles
constexpr float gather_width = 0.3F;  // [m] width over which colours of other surfaces are averaged

struct Texel {
  int patch = 0;
  int index = 0;
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
};

/// Point i of n of the Hammersley set, shifted by (a, b) and wrapped.
Eigen::Vector2f sample_point(int i, int n, float a, float b) {
  auto bits = static_cast<std::uint32_t>(i);
  bits = (bits << 16) | (bits >> 16);
  bits = ((bits & 0x55555555U) << 1) | ((bits & 0xAAAAAAAAU) >> 1);
  bits = ((bits & 0x33333333U) << 2) | ((bits & 0xCCCCCCCCU) >> 2);
  bits = ((bits & 0x0F0F0F0FU) << 4) | ((bits & 0xF0F0F0F0U) >> 4);
  bits = ((bits & 0x00FF00FFU) << 8) | ((bits & 0xFF00FF00U) >> 8);
  float x = (static_cast<float>(i) + 0.5F) / static_cast<float>(n) + a;
  float y = static_cast<float>(bits >> 8) / 16777216.0F + b;
  x -= std::floor(x);
  y -= std::floor(y);
  return {x, y};
}

/// Unit vectors that complete `normal` to a right-handed frame.
void tangents(const Eigen::Vector3f& normal, Eigen::Vector3f& s, Eigen::Vector3f& t) {
  const Eigen::Vector3f axis = std::abs(normal.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  s = axis.cross(normal).normalized();
  t = normal.cross(s);
}

/// Irradiance / pi from one light.
Eigen::Vector3f direct_light(const Scene& scene, const Light& light, const Texel& texel, int samples) {
  const Eigen::Vector3f origin = texel.position + lift * texel.normal;
  const Eigen::Vector3f light_normal = light.edge_v.cross(light.edge_u).normalized();
  const float area =
      light.radius > 0.0F ? 4.0F * float_pi * light.radius * light.radius : light.edge_u.cross(light.edge_v).norm();
  const float a = hash01(texel.patch, texel.index, 1);
  const float b = hash01(texel.patch, texel.index, 2);
  float sum = 0.0F;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2f r = sample_point(i, samples, a, b);
    Eigen::Vector3f target;
    Eigen::Vector3f normal = light_normal;
    if (light.radius > 0.0F) {
      const float z = 1.0F - 2.0F * r.x();
      const float ring = std::sqrt(std::max(0.0F, 1.0F - z * z));
      normal = {ring * std::cos(2.0F * float_pi * r.y()), ring * std::sin(2.0F * float_pi * r.y()), z};
      target = light.corner + light.radius * normal;
    } else {
      target = light.corner + r.x() * light.edge_u + r.y() * light.edge_v;
    }
    const Eigen::Vector3f to_light = target - origin;
    const float distance2 = std::max(to_light.squaredNorm(), nearest * nearest);
    const float distance = std::sqrt(distance2);
    const float cosine_here = to_light.dot(texel.normal) / distance;
    const float cosine_there = -to_light.dot(normal) / distance;
    if (cosine_here <= 0.0F || cosine_there <= 0.0F) continue;
    if (scene.occluded({origin, to_light, 0.0F, 1.0F - lift / distance})) continue;
    sum += cosine_here * cosine_there / distance2;
  }
  return light.radiance * (sum * area / (static_cast<float>(samples) * float_pi));
}

/// Irradiance / pi from other surfaces with their light of the previous round.
Eigen::Vector3f gathered_light(const Scene& scene, const Texel& texel, int samples) {
  const Eigen::Vector3f origin = texel.position + lift * texel.normal;
  Eigen::Vector3f s;
  Eigen::Vector3f t;
  tangents(texel.normal, s, t);
  const float a = hash01(texel.patch, texel.index, 3);
  const float b = hash01(texel.patch, texel.index, 4);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2f r = sample_point(i, samples, a, b);
    const float ring = std::sqrt(r.x());
    const Eigen::Vector3f direction = ring * std::cos(2.0F * float_pi * r.y()) * s +
                                      ring * std::sin(2.0F * float_pi * r.y()) * t +
                                      std::sqrt(1.0F - r.x()) * texel.normal;
    RayHit hit;
    if (!scene.closest({origin, direction}, hit)) continue;
    // The inside of a closed body reflects no light.
    const auto& triangle = scene.content().triangles[static_cast<std::size_t>(hit.triangle)];
    if (triangle.normal_world.dot(direction) > 0.0F) continue;
    sum += scene.albedo(hit, gather_width).cwiseProduct(scene.light(hit).cwiseMin(gather_limit));
  }
  return sum / static_cast<float>(samples);
}

/// Binomial 3x3 mean over a patch, which removes most of the sampling noise.
std::vector<Eigen::Vector3f> smoothed(const std::vector<Eigen::Vector3f>& light, int width, int height) {
  auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<Eigen::Vector3f> out(light.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const float weight = (dx == 0 ? 0.5F : 0.25F) * (dy == 0 ? 0.5F : 0.25F);
          sum += weight * light[at(std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1))];
        }
      }
      out[at(x, y)] = sum;
    }
  }
  return out;
}

}  // namespace

void LightingOptions::check() const {
  require(texel_m > 0.0F, "lighting.texel_m", "positive");
  require(max_texels >= 2 && max_texels <= 1024, "lighting.max_texels", "in 2..1024");
  require(light_samples >= 1 && light_samples <= 4096, "lighting.light_samples", "in 1..4096");
  require(gather_samples >= 1 && gather_samples <= 4096, "lighting.gather_samples", "in 1..4096");
  require(bounces >= 0 && bounces <= 8, "lighting.bounces", "in 0..8");
  require(exposure > 0.0F, "lighting.exposure", "positive");
}

void compute_light(SceneContent& content, const std::vector<PatchFrame>& frames, const std::vector<Light>& lights,
                   const LightingOptions& options) {
  options.check();
  require(frames.size() == content.patches.size(), "patch frames", "as many as patches");
  content.lit = true;
  content.exposure = options.exposure;
  std::vector<Texel> texels;
  for (std::size_t p = 0; p < frames.size(); ++p) {
    ScenePatch& patch = content.patches[p];
    auto count = [&](float size) {
      return std::clamp(static_cast<int>(std::ceil(size / options.texel_m)), 2, options.max_texels);
    };
    patch.light_width = count(frames[p].size_m.x());
    patch.light_height = count(frames[p].size_m.y());
    patch.light.clear();
    for (int y = 0; y < patch.light_height; ++y) {
      for (int x = 0; x < patch.light_width; ++x) {
        const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(patch.light_width);
        const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(patch.light_height);
        texels.push_back(
            {static_cast<int>(p), y * patch.light_width + x, frames[p].position(u, v), frames[p].normal(u, v)});
        patch.light.push_back(Eigen::Vector3f::Zero());
      }
    }
  }

  const int n = static_cast<int>(texels.size());
  constexpr int chunk = 64;
  std::vector<Eigen::Vector3f> direct(texels.size());
  {
    const Scene scene(content);
    parallel_for(n, chunk, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        direct[k].setZero();
        for (const Light& light : lights) direct[k] += direct_light(scene, light, texels[k], options.light_samples);
      }
    });
  }
  std::vector<Eigen::Vector3f> indirect(texels.size(), Eigen::Vector3f::Zero());
  for (int bounce = 0;; ++bounce) {
    std::size_t first = 0;
    for (ScenePatch& patch : content.patches) {
      const auto begin = static_cast<std::ptrdiff_t>(first);
      const auto size = static_cast<std::ptrdiff_t>(patch.light.size());
      const std::vector<Eigen::Vector3f> part(indirect.begin() + begin, indirect.begin() + begin + size);
      patch.light = smoothed(part, patch.light_width, patch.light_height);
      for (std::size_t i = 0; i < patch.light.size(); ++i) patch.light[i] += direct[first + i];
      first += patch.light.size();
    }
    if (bounce == options.bounces) return;
    const Scene scene(content);
    parallel_for(n, chunk, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        indirect[k] = gathered_light(scene, texels[k], options.gather_samples);
      }
    });
  }
}

}  // namespace odosplat
