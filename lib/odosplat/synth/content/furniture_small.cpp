// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cmath>

#include "odosplat/synth/content/furniture.hpp"

namespace odosplat {

void add_television(SceneBuilder& builder, float width, int screen, int body) {
  const float w = 0.5F * width;
  const float height = width * 9.0F / 16.0F + 0.02F;
  constexpr float foot = 0.04F;
  builder.add_box({-w, -0.02F, foot}, {w, 0.02F, foot + height}, body);
  builder.add_quad({-w + 0.015F, -0.0205F, foot + height - 0.015F}, {width - 0.03F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 0.03F - height}, screen);
  builder.add_box({-0.15F, -0.09F, 0.0F}, {0.15F, 0.09F, 0.015F}, body);
  builder.add_box({-0.04F, -0.01F, 0.015F}, {0.04F, 0.02F, foot + 0.01F}, body);
}

void add_flowers(SceneBuilder& builder, int vase, int stalk, int bloom_a, int bloom_b, Random& random) {
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.24F}, 0.05F, 0.085F, vase, 20, false);
  for (int i = 0; i < 7; ++i) {
    const auto a = static_cast<float>(random.uniform(0.0, 6.28));
    const auto r = static_cast<float>(random.uniform(0.05, 0.17));
    const Eigen::Vector3f top(r * std::cos(a), 0.6F * r * std::sin(a), static_cast<float>(random.uniform(0.36, 0.5)));
    builder.add_cylinder({0.0F, 0.0F, 0.12F}, top, 0.004F, 0.003F, stalk, 6, false);
    builder.add_cushion(top, {0.034F, 0.034F, 0.024F}, 1.0F, i % 2 == 0 ? bloom_a : bloom_b, 4);
  }
}

void add_clock(SceneBuilder& builder, float radius, int face, int hands) {
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, -0.03F, 0.0F}, radius, radius, face, 32, true);
  builder.add_box({-0.006F, -0.034F, 0.0F}, {0.006F, -0.031F, 0.75F * radius}, hands);
  builder.add_box({-0.004F, -0.034F, -0.006F}, {0.53F * radius, -0.031F, 0.006F}, hands);
}

void add_door(SceneBuilder& builder, float width, float height, int leaf, int frame, int handle) {
  const float w = 0.5F * width;
  constexpr float post = 0.08F;
  constexpr float proud = 0.03F;
  builder.add_box({-w - post, -proud, 0.0F}, {-w, 0.0F, height + post}, frame);
  builder.add_box({w, -proud, 0.0F}, {w + post, 0.0F, height + post}, frame);
  builder.add_box({-w, -proud, height}, {w, 0.0F, height + post}, frame);
  builder.add_box({-w, -0.012F, 0.0F}, {w, 0.0F, height}, leaf);
  for (const float z : {0.11F * height, 0.56F * height}) {
    builder.add_box({-w + 0.12F, -0.02F, z}, {w - 0.12F, -0.012F, z + 0.33F * height}, leaf);
  }
  const float x = w - 0.07F;
  builder.add_cylinder({x, -0.012F, 1.02F}, {x, -0.06F, 1.02F}, 0.01F, 0.01F, handle, 10, true);
  builder.add_cylinder({x + 0.01F, -0.06F, 1.02F}, {x - 0.11F, -0.06F, 1.02F}, 0.009F, 0.009F, handle, 10, true);
}

}  // namespace odosplat
