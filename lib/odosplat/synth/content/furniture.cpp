// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/furniture.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/angles.hpp"

namespace odosplat {
namespace {

int pick(Random& random, const std::vector<int>& of) { return of[random.below(static_cast<std::uint32_t>(of.size()))]; }

}  // namespace

Eigen::Isometry3f standing_at(float x, float y, float z, float degrees) {
  Eigen::Isometry3f T_world_local = Eigen::Isometry3f::Identity();
  T_world_local.translate(Eigen::Vector3f(x, y, z));
  T_world_local.rotate(Eigen::AngleAxisf(degrees * float_pi / 180.0F, Eigen::Vector3f::UnitZ()));
  return T_world_local;
}

void add_table(SceneBuilder& builder, const Eigen::Vector3f& size, float top_thickness, float leg, int top, int legs) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  const float below = size.z() - top_thickness;
  builder.add_box({-w, -d, below}, {w, d, size.z()}, top);
  const float inset = 0.04F;
  for (const float sx : {-1.0F, 1.0F}) {
    for (const float sy : {-1.0F, 1.0F}) {
      const float x = sx * (w - inset - 0.5F * leg);
      const float y = sy * (d - inset - 0.5F * leg);
      const float h = 0.5F * leg;
      builder.add_box({x - h, y - h, 0.0F}, {x + h, y + h, below}, {legs, legs, legs, legs, -1, -1});
    }
  }
  // Rails between the legs.
  const float rail = 0.08F;
  for (const float sy : {-1.0F, 1.0F}) {
    const float y = sy * (d - inset - 0.5F * leg);
    builder.add_box({-w + inset + leg, y - 0.01F, below - rail}, {w - inset - leg, y + 0.01F, below}, legs);
  }
  for (const float sx : {-1.0F, 1.0F}) {
    const float x = sx * (w - inset - 0.5F * leg);
    builder.add_box({x - 0.01F, -d + inset + leg, below - rail}, {x + 0.01F, d - inset - leg, below}, legs);
  }
}

void add_chair(SceneBuilder& builder, int wood, int seat) {
  constexpr float half = 0.2F;
  constexpr float radius = 0.017F;
  constexpr int round = 10;
  builder.add_cushion({0.0F, 0.0F, 0.455F}, {0.22F, 0.22F, 0.025F}, 0.25F, seat, 8);
  for (const float sx : {-1.0F, 1.0F}) {
    builder.add_cylinder({sx * (half + 0.02F), -half - 0.02F, 0.0F}, {sx * half, -half, 0.44F}, radius, radius, wood,
                         round, false);
    builder.add_cylinder({sx * (half + 0.02F), half + 0.03F, 0.0F}, {sx * half, half, 0.44F}, radius, radius, wood,
                         round, false);
    builder.add_cylinder({sx * half, half, 0.44F}, {sx * half, half + 0.07F, 0.92F}, radius, 0.013F, wood, round, true);
    builder.add_cylinder({sx * 0.205F, -half, 0.22F}, {sx * 0.205F, half, 0.22F}, 0.01F, 0.01F, wood, round, false);
  }
  for (const float z : {0.60F, 0.72F, 0.84F}) {
    const float y = half + 0.07F * (z - 0.44F) / 0.48F;
    builder.add_box({-half, y - 0.008F, z - 0.025F}, {half, y + 0.008F, z + 0.025F}, wood);
  }
}

void add_sofa(SceneBuilder& builder, float width, int cloth, int pillow_a, int pillow_b) {
  const float w = 0.5F * width;
  constexpr float arm = 0.18F;
  constexpr int cells = 8;
  builder.add_cushion({0.0F, 0.0F, 0.20F}, {w, 0.45F, 0.13F}, 0.2F, cloth, cells);
  for (const float sx : {-1.0F, 1.0F}) {
    builder.add_cushion({sx * (w - 0.5F * arm), -0.01F, 0.34F}, {0.5F * arm, 0.46F, 0.28F}, 0.3F, cloth, cells);
    for (const float sy : {-1.0F, 1.0F}) {
      builder.add_cylinder({sx * (w - 0.1F), sy * 0.36F, 0.0F}, {sx * (w - 0.1F), sy * 0.36F, 0.09F}, 0.02F, 0.03F,
                           pillow_b, 10, false);
    }
  }
  builder.add_cushion({0.0F, 0.38F, 0.50F}, {w - 0.02F, 0.10F, 0.32F}, 0.25F, cloth, cells);
  const int seats = std::max(2, static_cast<int>(width / 0.65F));
  const float seat = (width - 2.0F * arm) / static_cast<float>(seats);
  for (int i = 0; i < seats; ++i) {
    const float x = -w + arm + seat * (static_cast<float>(i) + 0.5F);
    builder.add_cushion({x, -0.10F, 0.385F}, {0.5F * seat - 0.004F, 0.36F, 0.075F}, 0.3F, cloth, cells);
    builder.add_cushion({x, 0.23F, 0.62F}, {0.5F * seat - 0.006F, 0.085F, 0.19F}, 0.45F, cloth, cells);
  }
  builder.add_cushion({-w + 0.38F, 0.10F, 0.60F}, {0.20F, 0.06F, 0.18F}, 0.6F, pillow_a, cells);
  builder.add_cushion({w - 0.40F, 0.09F, 0.60F}, {0.21F, 0.06F, 0.18F}, 0.6F, pillow_b, cells);
}

void add_bookshelf(SceneBuilder& builder, const Eigen::Vector3f& size, int boards, int doors, int wood,
                   const std::vector<int>& books, int paper, Random& random) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  constexpr float board = 0.022F;
  builder.add_box({-w, -d, 0.0F}, {-w + board, d, size.z()}, wood);
  builder.add_box({w - board, -d, 0.0F}, {w, d, size.z()}, wood);
  builder.add_box({-w, d - 0.01F, 0.0F}, {w, d, size.z()}, wood);
  const float pitch = (size.z() - 0.08F - board) / static_cast<float>(boards);
  for (int level = 0; level <= boards; ++level) {
    const float z = 0.08F + pitch * static_cast<float>(level);
    builder.add_box({-w + board, -d, z}, {w - board, d - 0.01F, z + board}, wood);
    if (level == boards) break;
    if (level < doors) {
      if (level > 0) continue;
      const float top = 0.08F + pitch * static_cast<float>(doors);
      builder.add_box({-w + board, -d - 0.004F, 0.09F}, {-0.002F, -d + 0.014F, top}, wood);
      builder.add_box({0.002F, -d - 0.004F, 0.09F}, {w - board, -d + 0.014F, top}, wood);
      continue;
    }
    const float floor = z + board;
    const float room = pitch - board;
    float x = -w + board + 0.004F;
    const float end = w - board - 0.004F;
    while (x < end - 0.06F) {
      if (random.uniform() < 0.06) {  // a gap
        x += between(random, 0.06, 0.22);
        continue;
      }
      const float thickness = between(random, 0.016, 0.05);
      const float height = room * between(random, 0.62, 0.93);
      const float depth = std::min(2.0F * d - 0.04F, between(random, 0.15, 0.24));
      const float front = -d + between(random, 0.005, 0.04);
      if (x + thickness > end) break;
      const int cover = pick(random, books);
      // Spine of the book to the front, paper on top.
      builder.add_box({x, front, floor}, {x + thickness - 0.001F, front + depth, floor + height},
                      {cover, cover, cover, -1, -1, paper});
      x += thickness;
    }
  }
}

void add_sideboard(SceneBuilder& builder, const Eigen::Vector3f& size, int wood, int front, int knobs) {
  const float w = 0.5F * size.x();
  const float d = 0.5F * size.y();
  constexpr float leg = 0.14F;
  builder.add_box({-w, -d, leg}, {w, d, size.z()}, wood);
  const int doors = std::max(2, static_cast<int>(size.x() / 0.5F));
  const float door = 2.0F * w / static_cast<float>(doors);
  for (int i = 0; i < doors; ++i) {
    const float x = -w + door * static_cast<float>(i);
    builder.add_box({x + 0.012F, -d - 0.016F, leg + 0.02F}, {x + door - 0.012F, -d, size.z() - 0.035F}, front);
    const float knob = x + (i % 2 == 0 ? door - 0.06F : 0.06F);
    builder.add_cushion({knob, -d - 0.03F, 0.6F * size.z()}, {0.014F, 0.014F, 0.014F}, 1.0F, knobs, 4);
  }
  for (const float sx : {-1.0F, 1.0F}) {
    for (const float sy : {-1.0F, 1.0F}) {
      const Eigen::Vector3f top(sx * (w - 0.12F), sy * (d - 0.06F), leg);
      builder.add_cylinder({top.x() + 0.03F * sx, top.y(), 0.0F}, top, 0.014F, 0.022F, wood, 10, false);
    }
  }
}

void add_picture(SceneBuilder& builder, float width, float height, float frame, int picture, int frame_material) {
  const float w = 0.5F * width;
  const float h = 0.5F * height;
  constexpr float depth = 0.03F;
  builder.add_quad({-w, -0.012F, h}, {width, 0.0F, 0.0F}, {0.0F, 0.0F, -height}, picture);
  builder.add_box({-w - frame, -depth, h}, {w + frame, 0.0F, h + frame}, frame_material);
  builder.add_box({-w - frame, -depth, -h - frame}, {w + frame, 0.0F, -h}, frame_material);
  builder.add_box({-w - frame, -depth, -h}, {-w, 0.0F, h}, frame_material);
  builder.add_box({w, -depth, -h}, {w + frame, 0.0F, h}, frame_material);
}

void add_plant(SceneBuilder& builder, float height, int leaves, int pot, int leaf, int earth, Random& random) {
  const float pot_height = 0.28F;
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, pot_height}, 0.12F, 0.17F, pot, 24, false);
  builder.add_cylinder({0.0F, 0.0F, pot_height - 0.04F}, {0.0F, 0.0F, pot_height - 0.035F}, 0.165F, 0.165F, earth, 24,
                       true);
  for (int i = 0; i < leaves; ++i) {
    const float around = 2.0F * float_pi * (static_cast<float>(i) * 0.381966F + between(random, 0.0, 0.06));
    const float rise = (height - pot_height) * between(random, 0.55, 1.0);
    const float reach = height * between(random, 0.16, 0.3);
    const float width = between(random, 0.05, 0.09);
    const Eigen::Vector3f out(std::cos(around), std::sin(around), 0.0F);
    const Eigen::Vector3f side(-std::sin(around), std::cos(around), 0.0F);
    const Eigen::Vector3f foot = 0.03F * out + Eigen::Vector3f(0.0F, 0.0F, pot_height - 0.05F);
    // v runs from the tip down to the foot: a stalk that widens into an arching blade.
    auto spine = [=](float s) -> Eigen::Vector3f {
      return foot + reach * s * s * out + Eigen::Vector3f(0.0F, 0.0F, rise * std::sin(0.62F * float_pi * s));
    };
    auto blade = [=](float s) {
      return s < 0.35F ? 0.006F : 0.006F + width * std::sin(float_pi * (s - 0.35F) / 0.65F);
    };
    SceneBuilder::Surface surface;
    surface.position = [=](float u, float v) -> Eigen::Vector3f {
      const float s = 1.0F - v;
      const float across = 2.0F * u - 1.0F;
      return spine(s) + blade(s) * across * side + Eigen::Vector3f(0.0F, 0.0F, 0.3F * blade(s) * std::abs(across));
    };
    surface.normal = [=](float, float v) -> Eigen::Vector3f {
      const float s = 1.0F - v;
      const Eigen::Vector3f along = spine(s + 0.01F) - spine(s - 0.01F);
      Eigen::Vector3f normal = along.cross(side);
      if (normal.z() < 0.0F) normal = -normal;
      return normal.normalized();
    };
    surface.segments_u = 2;
    surface.segments_v = 12;
    surface.size_m = {2.0F * width, reach + rise};
    surface.material = leaf;
    builder.add_surface(surface);
  }
}

void add_floor_lamp(SceneBuilder& builder, int metal, int shade, const Eigen::Vector3f& radiance) {
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.025F}, 0.15F, 0.14F, metal, 24, true);
  builder.add_cylinder({0.0F, 0.0F, 0.025F}, {0.0F, 0.0F, 1.42F}, 0.011F, 0.011F, metal, 10, false);
  builder.add_cylinder({0.0F, 0.0F, 1.32F}, {0.0F, 0.0F, 1.60F}, 0.21F, 0.15F, shade, 32, false);
  builder.add_lamp({0.0F, 0.0F, 1.46F}, 0.06F, radiance);
}

void add_window(SceneBuilder& builder, float width, float height, float depth, int wall, int frame,
                const Eigen::Vector3f& radiance) {
  // Reveal: left, right, top, bottom.
  builder.add_quad({0.0F, 0.0F, height}, {0.0F, depth, 0.0F}, {0.0F, 0.0F, -height}, wall);
  builder.add_quad({width, depth, height}, {0.0F, -depth, 0.0F}, {0.0F, 0.0F, -height}, wall);
  builder.add_quad({0.0F, 0.0F, height}, {width, 0.0F, 0.0F}, {0.0F, depth, 0.0F}, wall);
  builder.add_quad({0.0F, depth, 0.0F}, {width, 0.0F, 0.0F}, {0.0F, -depth, 0.0F}, wall);
  builder.add_box({-0.05F, -0.16F, -0.03F}, {width + 0.05F, 0.06F, 0.0F}, frame);
  constexpr float bar = 0.055F;
  const float y0 = depth - 0.07F;
  const float y1 = depth - 0.01F;
  builder.add_box({0.0F, y0, 0.0F}, {width, y1, bar}, frame);
  builder.add_box({0.0F, y0, height - bar}, {width, y1, height}, frame);
  for (const float x : {0.0F, 0.5F * (width - bar), width - bar}) {
    builder.add_box({x, y0, bar}, {x + bar, y1, height - bar}, frame);
  }
  builder.add_box({bar, y0 + 0.01F, 0.68F * height}, {width - bar, y1 - 0.01F, 0.68F * height + 0.03F}, frame);
  builder.add_window_light({0.0F, depth, height}, {width, 0.0F, 0.0F}, {0.0F, 0.0F, -height}, radiance);
}

void add_curtain(SceneBuilder& builder, float width, float height, int folds, int cloth) {
  const auto n = static_cast<float>(folds);
  auto depth = [=](float u, float v) {
    return (0.02F + 0.03F * v) * std::sin(2.0F * float_pi * n * u) +
           0.012F * std::sin(2.0F * float_pi * (1.7F * n * u + 0.4F * v));
  };
  SceneBuilder::Surface surface;
  surface.position = [=](float u, float v) -> Eigen::Vector3f {
    return {(u - 0.5F) * width, depth(u, v), height + v * (0.05F - height)};
  };
  surface.normal = [=](float u, float v) -> Eigen::Vector3f {
    const float slope = (depth(u + 0.002F, v) - depth(u - 0.002F, v)) / (0.004F * width);
    return Eigen::Vector3f(slope, -1.0F, 0.0F).normalized();
  };
  surface.segments_u = 12 * folds;
  surface.segments_v = 4;
  surface.size_m = {1.4F * width, height};
  surface.material = cloth;
  builder.add_surface(surface);
}

void add_radiator(SceneBuilder& builder, float width, int metal) {
  const float w = 0.5F * width;
  builder.add_box({-w, -0.09F, 0.12F}, {w, -0.05F, 0.67F}, metal);
  const int ribs = static_cast<int>(width / 0.07F);
  for (int i = 0; i < ribs; ++i) {
    const float x = -w + (static_cast<float>(i) + 0.5F) * width / static_cast<float>(ribs);
    builder.add_box({x - 0.018F, -0.12F, 0.15F}, {x + 0.018F, -0.105F, 0.64F}, metal);
  }
}

void add_tableware(SceneBuilder& builder, const std::vector<int>& books, int paper, int bowl, int mug, Random& random) {
  float z = 0.0F;
  for (int i = 0; i < 3; ++i) {
    const float thickness = between(random, 0.015, 0.035);
    const float w = 0.5F * between(random, 0.20, 0.26);
    const float d = 0.5F * between(random, 0.15, 0.18);
    const float dx = -0.28F + between(random, -0.02, 0.02);
    const int cover = pick(random, books);
    builder.add_box({dx - w, -d, z}, {dx + w, d, z + thickness}, {paper, paper, cover, paper, -1, cover});
    z += thickness;
  }
  // A bowl: outside and inside.
  builder.add_cylinder({0.12F, 0.05F, 0.0F}, {0.12F, 0.05F, 0.07F}, 0.05F, 0.12F, bowl, 24, false);
  builder.add_cushion({0.10F, 0.04F, 0.065F}, {0.038F, 0.038F, 0.036F}, 1.0F, mug, 6);
  builder.add_cushion({0.16F, 0.07F, 0.065F}, {0.036F, 0.036F, 0.036F}, 1.0F, mug, 6);
  builder.add_cylinder({0.32F, -0.10F, 0.0F}, {0.32F, -0.10F, 0.095F}, 0.038F, 0.041F, mug, 20, true);
}

}  // namespace odosplat
