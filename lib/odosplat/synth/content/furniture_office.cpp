// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/furniture_office.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"
#include "odosplat/synth/content/furniture.hpp"

namespace odosplat {

void add_desk(SceneBuilder& builder, const Eigen::Vector3f& size, int top, int frame) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  const float below = size.z() - 0.025F;
  builder.add_box({-w, -d, below}, {w, d, size.z()}, top);
  for (const float sx : {-1.0F, 1.0F}) {
    const float x = sx * (w - 0.09F);
    builder.add_box({x - 0.03F, -d + 0.06F, 0.0F}, {x + 0.03F, d - 0.06F, 0.03F}, frame);
    builder.add_box({x - 0.025F, 0.02F, 0.03F}, {x + 0.025F, 0.10F, below}, frame);
  }
  builder.add_box({-w + 0.1F, d - 0.10F, 0.32F}, {w - 0.1F, d - 0.08F, below - 0.06F}, top);
  builder.add_box({-w + 0.25F, d - 0.24F, below - 0.11F}, {w - 0.25F, d - 0.12F, below - 0.05F}, frame);
}

void add_office_chair(SceneBuilder& builder, int cloth, int plastic, int metal) {
  for (int i = 0; i < 5; ++i) {
    const float angle = 2.0F * float_pi * (static_cast<float>(i) + 0.25F) / 5.0F;
    const Eigen::Vector3f out(std::cos(angle), std::sin(angle), 0.0F);
    builder.add_cylinder({0.0F, 0.0F, 0.11F}, 0.29F * out + Eigen::Vector3f(0.0F, 0.0F, 0.075F), 0.022F, 0.016F,
                         plastic, 8, true);
    const Eigen::Vector3f side(-out.y(), out.x(), 0.0F);
    const Eigen::Vector3f hub = 0.29F * out + Eigen::Vector3f(0.0F, 0.0F, 0.03F);
    builder.add_cylinder(hub - 0.02F * side, hub + 0.02F * side, 0.03F, 0.03F, plastic, 12, true);
  }
  builder.add_cylinder({0.0F, 0.0F, 0.1F}, {0.0F, 0.0F, 0.43F}, 0.025F, 0.025F, metal, 12, false);
  builder.add_cushion({0.0F, 0.0F, 0.475F}, {0.25F, 0.24F, 0.045F}, 0.35F, cloth, 8);
  builder.add_box({-0.03F, 0.2F, 0.42F}, {0.03F, 0.26F, 0.66F}, plastic);
  builder.add_cushion({0.0F, 0.265F, 0.8F}, {0.225F, 0.04F, 0.29F}, 0.45F, cloth, 10);
  for (const float sx : {-1.0F, 1.0F}) {
    builder.add_box({sx * 0.27F - 0.015F, -0.03F, 0.44F}, {sx * 0.27F + 0.015F, 0.03F, 0.66F}, plastic);
    builder.add_box({sx * 0.27F - 0.035F, -0.14F, 0.66F}, {sx * 0.27F + 0.035F, 0.12F, 0.685F}, plastic);
  }
}

void add_monitor(SceneBuilder& builder, float width, int screen, int plastic) {
  const float w = 0.5F * width;
  const float height = width * 9.0F / 16.0F;
  constexpr float rim = 0.012F;
  constexpr float lift = 0.14F;
  builder.add_box({-w - rim, -0.005F, lift}, {w + rim, 0.03F, lift + height + 2.0F * rim}, plastic);
  builder.add_quad({-w, -0.0055F, lift + rim + height}, {width, 0.0F, 0.0F}, {0.0F, 0.0F, -height}, screen);
  builder.add_box({-0.03F, 0.03F, 0.015F}, {0.03F, 0.055F, lift + 0.5F * height}, plastic);
  builder.add_box({-0.12F, -0.06F, 0.0F}, {0.12F, 0.12F, 0.015F}, plastic);
}

void add_keyboard(SceneBuilder& builder, int keys, int plastic) {
  builder.add_box({-0.22F, -0.07F, 0.0F}, {0.22F, 0.07F, 0.018F}, {plastic, plastic, plastic, plastic, -1, keys});
  builder.add_cushion({0.31F, 0.0F, 0.012F}, {0.032F, 0.052F, 0.022F}, 0.8F, plastic, 6);
}

void add_desk_lamp(SceneBuilder& builder, float height, int metal, int shade, const Eigen::Vector3f& radiance) {
  const Eigen::Vector3f elbow(0.0F, 0.14F, height);
  const Eigen::Vector3f head(0.0F, -0.22F, height + 0.06F);
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.02F}, 0.09F, 0.085F, metal, 24, true);
  builder.add_cylinder({0.0F, 0.0F, 0.02F}, elbow, 0.007F, 0.007F, metal, 8, false);
  builder.add_cushion(elbow, {0.014F, 0.014F, 0.014F}, 1.0F, metal, 4);
  builder.add_cylinder(elbow, head, 0.006F, 0.006F, metal, 8, false);
  builder.add_cylinder(head - Eigen::Vector3f(0.0F, 0.0F, 0.11F), head, 0.08F, 0.025F, shade, 24, false);
  builder.add_lamp(head - Eigen::Vector3f(0.0F, 0.0F, 0.08F), 0.025F, radiance);
}

void add_drawers(SceneBuilder& builder, const Eigen::Vector3f& size, int drawers, int body, int front, int handle) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  builder.add_box({-w, -d, 0.03F}, {w, d, size.z()}, body);
  builder.add_box({-w + 0.03F, -d + 0.03F, 0.0F}, {w - 0.03F, d - 0.03F, 0.03F}, handle);
  const float pitch = (size.z() - 0.05F) / static_cast<float>(drawers);
  for (int i = 0; i < drawers; ++i) {
    const float z = 0.04F + pitch * static_cast<float>(i);
    builder.add_box({-w + 0.006F, -d - 0.014F, z}, {w - 0.006F, -d, z + pitch - 0.008F}, front);
    builder.add_box({-0.07F, -d - 0.034F, z + 0.66F * pitch}, {0.07F, -d - 0.026F, z + 0.66F * pitch + 0.012F}, handle);
    for (const float x : {-0.065F, 0.057F}) {
      builder.add_box({x, -d - 0.027F, z + 0.66F * pitch}, {x + 0.008F, -d - 0.013F, z + 0.66F * pitch + 0.012F},
                      handle);
    }
  }
}

void add_whiteboard(SceneBuilder& builder, float width, float height, int board, int frame, int pens) {
  const float w = 0.5F * width;
  const float h = 0.5F * height;
  constexpr float rim = 0.02F;
  builder.add_quad({-w, -0.014F, h}, {width, 0.0F, 0.0F}, {0.0F, 0.0F, -height}, board);
  builder.add_box({-w - rim, -0.025F, h}, {w + rim, 0.0F, h + rim}, frame);
  builder.add_box({-w - rim, -0.025F, -h - rim}, {w + rim, 0.0F, -h}, frame);
  builder.add_box({-w - rim, -0.025F, -h}, {-w, 0.0F, h}, frame);
  builder.add_box({w, -0.025F, -h}, {w + rim, 0.0F, h}, frame);
  builder.add_box({-0.25F * width, -0.09F, -h - rim}, {0.25F * width, -0.025F, -h - 0.005F}, frame);
  for (int i = 0; i < 3; ++i) {
    const float x = 0.18F * static_cast<float>(i) - 0.2F;
    builder.add_cylinder({x, -0.06F, -h + 0.006F}, {x + 0.13F, -0.06F, -h + 0.006F}, 0.009F, 0.009F, pens, 10, true);
  }
}

void add_partition(SceneBuilder& builder, float width, float height, int cloth, int frame) {
  const float w = 0.5F * width;
  builder.add_box({-w, -0.022F, 0.08F}, {w, 0.022F, height}, cloth);
  builder.add_box({-w, -0.025F, height}, {w, 0.025F, height + 0.02F}, frame);
  for (const float sx : {-1.0F, 1.0F}) {
    builder.add_box({sx * w - 0.015F, -0.027F, 0.02F}, {sx * w + 0.015F, 0.027F, height + 0.02F}, frame);
    builder.add_box({sx * w - 0.03F, -0.2F, 0.0F}, {sx * w + 0.03F, 0.2F, 0.02F}, frame);
  }
}

void add_ceiling_light(SceneBuilder& builder, const Eigen::Vector2f& size, int panel, int frame,
                       const Eigen::Vector3f& radiance) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  builder.add_box({-w - 0.02F, -d - 0.02F, -0.02F}, {w + 0.02F, d + 0.02F, -0.001F}, frame);
  const Eigen::Vector3f corner(-w, -d, -0.022F);
  const Eigen::Vector3f dx(size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f dy(0.0F, size.y(), 0.0F);
  builder.add_quad(corner, dx, dy, panel);
  builder.add_window_light(corner - Eigen::Vector3f(0.0F, 0.0F, 0.004F), dx, dy, radiance);
}

void add_blind(SceneBuilder& builder, float width, float height, float tilt_deg, int slat, int cord) {
  constexpr float pitch = 0.042F;
  const float tilt = tilt_deg * float_pi / 180.0F;
  const Eigen::Vector3f across(0.0F, 0.025F * std::cos(tilt), 0.025F * std::sin(tilt));
  builder.add_box({0.0F, -0.03F, height - 0.04F}, {width, 0.03F, height}, slat);
  builder.add_box({0.0F, -0.015F, 0.0F}, {width, 0.015F, 0.015F}, slat);
  const int slats = static_cast<int>((height - 0.08F) / pitch);
  for (int i = 0; i < slats; ++i) {
    const Eigen::Vector3f left(0.0F, 0.0F, 0.04F + pitch * static_cast<float>(i));
    // Both sides are seen and lit.
    builder.add_quad(left + across, {width, 0.0F, 0.0F}, -2.0F * across, slat);
    builder.add_quad(left - across - Eigen::Vector3f(0.0F, 0.0F, 0.001F), {width, 0.0F, 0.0F}, 2.0F * across, slat);
  }
  for (const float share : {0.12F, 0.88F}) {
    const float x = share * width;
    builder.add_box({x - 0.002F, -0.028F, 0.0F}, {x + 0.002F, -0.026F, height}, cord);
  }
}

void add_cable(SceneBuilder& builder, const std::vector<Eigen::Vector3f>& points, float radius, int material) {
  constexpr int pieces = 8;
  auto at = [&](int i) -> const Eigen::Vector3f& {
    return points[static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(points.size()) - 1))];
  };
  for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) {
    auto curve = [&](float t) -> Eigen::Vector3f {  // uniform Catmull-Rom
      return 0.5F * (2.0F * at(i) + t * (at(i + 1) - at(i - 1)) +
                     t * t * (2.0F * at(i - 1) - 5.0F * at(i) + 4.0F * at(i + 1) - at(i + 2)) +
                     t * t * t * (3.0F * at(i) - at(i - 1) - 3.0F * at(i + 1) + at(i + 2)));
    };
    for (int k = 0; k < pieces; ++k) {
      const float t0 = static_cast<float>(k) / pieces;
      builder.add_cylinder(curve(t0), curve(t0 + 1.0F / pieces), radius, radius, material, 6, false);
    }
  }
}

void add_bin(SceneBuilder& builder, int body, int paper) {
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.3F}, 0.1F, 0.13F, body, 24, false);
  builder.add_cushion({0.02F, 0.01F, 0.22F}, {0.07F, 0.06F, 0.05F}, 0.9F, paper, 6);
  builder.add_cylinder({0.0F, 0.0F, 0.17F}, {0.0F, 0.0F, 0.175F}, 0.11F, 0.11F, body, 24, true);
}

void add_papers(SceneBuilder& builder, int sheets, const std::vector<int>& pages, Random& random) {
  for (int i = 0; i < sheets; ++i) {
    const float angle = between(random, -0.5, 0.5);
    const Eigen::Vector3f right(std::cos(angle), std::sin(angle), 0.0F);
    const Eigen::Vector3f down(std::sin(angle), -std::cos(angle), 0.0F);
    const float lift = 0.0008F * static_cast<float>(i + 1);
    const Eigen::Vector3f centre(between(random, -0.14, 0.14), between(random, -0.1, 0.1), lift);
    const int page = pages[random.below(static_cast<std::uint32_t>(pages.size()))];
    builder.add_quad(centre - 0.105F * right - 0.1485F * down, 0.21F * right, 0.297F * down, page);
  }
}

}  // namespace odosplat
