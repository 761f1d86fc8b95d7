// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/patterns.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {

Scene make_box_room(std::uint64_t seed) {
  SceneBuilder builder;
  const auto s = static_cast<std::uint32_t>(seed * 97);
  auto marble = [&](std::uint32_t k, const Eigen::Vector3f& low, const Eigen::Vector3f& middle,
                    const Eigen::Vector3f& high) {
    Material material;
    material.texture = builder.add_texture(marble_pattern(512, 8, low, middle, high, s + k), {2.0F, 2.0F});
    return builder.add_material(material);
  };
  const int west = marble(1, {0.1F, 0.15F, 0.3F}, {0.5F, 0.5F, 0.6F}, {0.95F, 0.9F, 0.8F});
  const int east = marble(2, {0.3F, 0.1F, 0.1F}, {0.6F, 0.5F, 0.4F}, {0.9F, 0.9F, 0.85F});
  const int south = marble(3, {0.1F, 0.25F, 0.15F}, {0.45F, 0.55F, 0.4F}, {0.9F, 0.95F, 0.7F});
  const int north = marble(4, {0.15F, 0.1F, 0.2F}, {0.6F, 0.55F, 0.5F}, {0.95F, 0.95F, 0.95F});
  const int floor = marble(5, {0.2F, 0.12F, 0.08F}, {0.5F, 0.4F, 0.3F}, {0.85F, 0.75F, 0.6F});
  const int ceiling = marble(6, {0.35F, 0.35F, 0.35F}, {0.65F, 0.65F, 0.65F}, {0.95F, 0.95F, 0.95F});

  const Eigen::Vector3f size(4.0F, 3.0F, 2.5F);
  const Eigen::Vector3f dx(size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f dy(0.0F, size.y(), 0.0F);
  const Eigen::Vector3f dz(0.0F, 0.0F, size.z());
  builder.add_quad(dz, dy, -dz, west);
  builder.add_quad(dx + dy + dz, -dy, -dz, east);
  builder.add_quad(dx + dz, -dx, -dz, south);
  builder.add_quad(dy + dz, dx, -dz, north);
  builder.add_quad(dy, dx, -dy, floor);
  builder.add_quad(dz, dx, dy, ceiling);
  builder.add_box({2.6F, 1.9F, 0.0F}, {3.2F, 2.5F, 0.9F}, south);
  builder.add_box({1.2F, 2.2F, 0.0F}, {1.9F, 2.7F, 0.5F}, west);
  builder.add_cushion({2.0F, 1.9F, 0.25F}, {0.25F, 0.25F, 0.25F}, 1.0F, east, 12);
  return builder.build_unlit();
}

}  // namespace odosplat
