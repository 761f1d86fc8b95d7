// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cmath>
#include <vector>

#include "odosplat/synth/furniture.hpp"
#include "odosplat/synth/patterns.hpp"
#include "odosplat/synth/rooms.hpp"
#include "odosplat/synth/scene_builder.hpp"

namespace odosplat {
namespace {

using Color = Eigen::Vector3f;

constexpr float room_x = 6.0F;  // [m]
constexpr float room_y = 4.6F;
constexpr float room_z = 2.6F;

struct Materials {
  int wall, accent_wall, ceiling, floor, skirting, brick, carpet;
  int oak, walnut, white, metal, black, screen;
  int sofa_cloth, seat_cloth, pillow_a, pillow_b, curtain;
  int paper, terracotta, earth, leaf, china, fruit, lamp_shade, pendant;
  std::vector<int> books, pictures;
};

Materials make_materials(SceneBuilder& builder, std::uint64_t seed) {
  const auto s = static_cast<std::uint32_t>(seed * 1013 + 17);
  auto textured = [&](const ColorImage& image, const Eigen::Vector2f& size_m, bool fit = false, float gloss = 0.0F) {
    Material material;
    const Texture::Edge edge = fit ? Texture::Edge::clamp : Texture::Edge::repeat;
    material.texture = builder.add_texture(image, size_m, edge);
    material.fit = fit;
    material.gloss = gloss;
    return builder.add_material(material);
  };
  auto plain = [&](const Color& color, float gloss) {
    Material material;
    material.tint = color;
    material.gloss = gloss;
    return builder.add_material(material);
  };
  auto glowing = [&](const Color& color, float emission) {
    Material material;
    material.tint = color;
    material.emission = emission;
    material.casts_shadow = false;
    return builder.add_material(material);
  };

  Materials m;
  m.wall = textured(plaster_pattern(512, {0.88F, 0.86F, 0.81F}, 0.02F, s + 1), {2.0F, 2.0F});
  m.accent_wall = textured(plaster_pattern(512, {0.62F, 0.70F, 0.68F}, 0.03F, s + 2), {2.0F, 2.0F});
  m.ceiling = textured(plaster_pattern(512, {0.93F, 0.93F, 0.91F}, 0.012F, s + 3), {2.0F, 2.0F});
  m.floor = textured(plank_pattern(1024, 14, {0.56F, 0.41F, 0.28F}, {0.68F, 0.52F, 0.37F}, s + 4), {2.2F, 2.2F});
  m.skirting = plain({0.90F, 0.89F, 0.86F}, 0.0F);
  m.brick = textured(brick_pattern(512, 512, 4, 14, s + 5), {0.96F, 1.05F});
  m.carpet = textured(carpet_pattern(768, 512, s + 6), {2.4F, 1.6F}, true);
  m.oak = textured(wood_pattern(512, 512, {0.66F, 0.49F, 0.31F}, {0.78F, 0.61F, 0.41F}, s + 7), {0.9F, 0.45F});
  m.walnut = textured(wood_pattern(512, 512, {0.30F, 0.19F, 0.13F}, {0.42F, 0.28F, 0.19F}, s + 8), {0.9F, 0.45F});
  m.white = textured(plaster_pattern(128, {0.90F, 0.90F, 0.88F}, 0.01F, s + 9), {0.5F, 0.5F});
  m.metal = plain({0.82F, 0.82F, 0.80F}, 0.04F);
  m.black = plain({0.10F, 0.10F, 0.11F}, 0.0F);
  m.screen = plain({0.06F, 0.06F, 0.07F}, 0.05F);
  m.sofa_cloth = textured(cloth_pattern(512, {0.42F, 0.48F, 0.55F}, {0.0F, 0.0F, 0.0F}, 0, s + 10), {0.5F, 0.5F});
  m.seat_cloth = textured(cloth_pattern(256, {0.60F, 0.30F, 0.22F}, {0.0F, 0.0F, 0.0F}, 0, s + 11), {0.3F, 0.3F});
  m.pillow_a = textured(cloth_pattern(256, {0.86F, 0.80F, 0.68F}, {0.70F, 0.28F, 0.20F}, 4, s + 12), {0.3F, 0.3F});
  m.pillow_b = textured(picture_pattern(256, 256, 2, s + 13), {0.4F, 0.4F}, true);
  m.paper = plain({0.88F, 0.85F, 0.77F}, 0.0F);
  m.terracotta = textured(plaster_pattern(256, {0.70F, 0.42F, 0.30F}, 0.10F, s + 15), {0.4F, 0.4F});
  m.earth = textured(plaster_pattern(128, {0.24F, 0.17F, 0.12F}, 0.5F, s + 16), {0.2F, 0.2F});
  m.leaf = textured(plaster_pattern(256, {0.27F, 0.46F, 0.22F}, 0.25F, s + 17), {0.3F, 0.3F});
  m.china = plain({0.86F, 0.88F, 0.90F}, 0.03F);
  m.fruit = textured(plaster_pattern(128, {0.82F, 0.42F, 0.15F}, 0.12F, s + 18), {0.1F, 0.1F});
  m.lamp_shade = glowing({0.98F, 0.90F, 0.74F}, 0.9F);
  m.pendant = plain({0.32F, 0.36F, 0.34F}, 0.0F);
  {
    Material curtain;
    curtain.texture =
        builder.add_texture(cloth_pattern(256, {0.80F, 0.76F, 0.66F}, {0.70F, 0.66F, 0.56F}, 3, s + 14), {0.6F, 0.6F});
    m.curtain = builder.add_material(curtain);
  }

  Random random(seed + 5);
  for (std::uint32_t i = 0; i < 8; ++i) {
    const int texture = builder.add_texture(book_pattern(48, 256, s + 40 + i), {0.03F, 0.2F}, Texture::Edge::clamp);
    for (int k = 0; k < 3; ++k) {
      Material material;
      material.texture = texture;
      material.fit = true;
      const Color muted[6] = {{0.62F, 0.32F, 0.27F}, {0.34F, 0.42F, 0.54F}, {0.36F, 0.48F, 0.38F},
                              {0.76F, 0.70F, 0.58F}, {0.42F, 0.35F, 0.31F}, {0.70F, 0.56F, 0.34F}};
      material.tint = muted[random.below(6)] * static_cast<float>(random.uniform(0.85, 1.1));
      m.books.push_back(builder.add_material(material));
    }
  }
  for (int i = 0; i < 6; ++i) {
    const auto own = s + 60 + static_cast<std::uint32_t>(i);
    const int width = i == 0 ? 512 : 256;
    const int height = i == 0 ? 320 : 256;
    m.pictures.push_back(textured(picture_pattern(width, height, i, own), {1.0F, 1.0F}, true));
  }
  return m;
}

/// Inside of the north wall between x0..x1 and z0..z1, its texture going on from piece to piece.
void add_north_wall(SceneBuilder& builder, int material, float x0, float x1, float z0, float z1) {
  builder.add_quad({x0, room_y, z1}, {x1 - x0, 0.0F, 0.0F}, {0.0F, 0.0F, z0 - z1}, material, {x0, room_z - z1});
}

void add_shell(SceneBuilder& builder, const Materials& m) {
  builder.place(Eigen::Isometry3f::Identity());
  const Eigen::Vector3f dx(room_x, 0.0F, 0.0F);
  const Eigen::Vector3f dy(0.0F, room_y, 0.0F);
  const Eigen::Vector3f dz(0.0F, 0.0F, room_z);
  builder.add_quad(dy, dx, -dy, m.floor);
  builder.add_quad(dz, dx, dy, m.ceiling);
  builder.add_quad(dz, dy, -dz, m.accent_wall);      // west
  builder.add_quad(dx + dy + dz, -dy, -dz, m.wall);  // east
  builder.add_quad(dx + dz, -dx, -dz, m.wall);       // south

  // North, around two windows.
  constexpr float sill = 0.85F;
  constexpr float lintel = 2.20F;
  constexpr float left[2] = {0.9F, 3.5F};
  constexpr float width = 1.4F;
  constexpr float depth = 0.16F;
  const Eigen::Vector3f daylight(7.5F, 7.9F, 8.4F);
  add_north_wall(builder, m.wall, 0.0F, room_x, 0.0F, sill);
  add_north_wall(builder, m.wall, 0.0F, room_x, lintel, room_z);
  add_north_wall(builder, m.wall, 0.0F, left[0], sill, lintel);
  add_north_wall(builder, m.wall, left[0] + width, left[1], sill, lintel);
  add_north_wall(builder, m.wall, left[1] + width, room_x, sill, lintel);
  for (const float x : left) {
    builder.place(standing_at(x, room_y, sill, 0.0F));
    add_window(builder, width, lintel - sill, depth, m.wall, m.white, daylight);
    builder.place(standing_at(x + 0.5F * width, room_y, 0.0F, 0.0F));
    add_radiator(builder, 1.1F, m.metal);
    builder.add_cylinder({-1.05F, -0.12F, 2.36F}, {1.05F, -0.12F, 2.36F}, 0.014F, 0.014F, m.walnut, 10, true);
    for (const float side : {-1.0F, 1.0F}) {
      builder.place(standing_at(x + 0.5F * width + side * 0.86F, room_y - 0.12F, 0.0F, 0.0F));
      add_curtain(builder, 0.34F, 2.34F, 4, m.curtain);
    }
  }

  // Skirting boards.
  builder.place(Eigen::Isometry3f::Identity());
  constexpr float thick = 0.015F;
  constexpr float high = 0.09F;
  builder.add_box({0.0F, 0.0F, 0.0F}, {thick, room_y, high}, m.skirting);
  builder.add_box({room_x - thick, 0.0F, 0.0F}, {room_x, room_y, high}, m.skirting);
  builder.add_box({0.0F, 0.0F, 0.0F}, {room_x, thick, high}, m.skirting);
  builder.add_box({0.0F, room_y - thick, 0.0F}, {room_x, room_y, high}, m.skirting);

  // Chimney breast and door on the south wall.
  builder.add_box({2.15F, 0.0F, 0.0F}, {3.05F, 0.32F, room_z}, m.brick);
  builder.add_box({0.55F, 0.0F, 0.0F}, {0.63F, 0.03F, 2.08F}, m.white);
  builder.add_box({1.49F, 0.0F, 0.0F}, {1.57F, 0.03F, 2.08F}, m.white);
  builder.add_box({0.63F, 0.0F, 2.0F}, {1.49F, 0.03F, 2.08F}, m.white);
  builder.add_box({0.63F, 0.0F, 0.0F}, {1.49F, 0.012F, 2.0F}, m.oak);
  for (const float z : {0.22F, 1.12F}) {
    builder.add_box({0.75F, 0.012F, z}, {1.37F, 0.02F, z + 0.66F}, m.oak);
  }
  builder.add_cylinder({1.42F, 0.012F, 1.02F}, {1.42F, 0.06F, 1.02F}, 0.01F, 0.01F, m.metal, 10, true);
  builder.add_cylinder({1.43F, 0.06F, 1.02F}, {1.31F, 0.06F, 1.02F}, 0.009F, 0.009F, m.metal, 10, true);
}

void add_sitting_corner(SceneBuilder& builder, const Materials& m, Random& random) {
  builder.place(Eigen::Isometry3f::Identity());
  builder.add_box({2.95F, 1.0F, 0.0F}, {4.55F, 3.4F, 0.012F}, m.black);
  // The carpet's long side runs along y.
  builder.add_quad({2.95F, 1.0F, 0.0125F}, {0.0F, 2.4F, 0.0F}, {1.6F, 0.0F, 0.0F}, m.carpet);
  builder.place(standing_at(5.45F, 2.2F, 0.0F, -90.0F));
  add_sofa(builder, 2.1F, m.sofa_cloth, m.pillow_a, m.pillow_b);
  builder.place(standing_at(3.9F, 2.2F, 0.0125F, 90.0F));
  add_table(builder, {1.05F, 0.6F, 0.42F}, 0.03F, 0.05F, m.walnut, m.walnut);
  builder.place(standing_at(3.9F, 2.2F, 0.4325F, 90.0F));
  add_tableware(builder, m.books, m.paper, m.china, m.fruit, random);
  builder.place(standing_at(4.05F, 3.95F, 0.0F, 165.0F + 180.0F));
  add_sofa(builder, 0.95F, m.seat_cloth, m.pillow_b, m.pillow_a);
  builder.place(standing_at(5.62F, 3.85F, 0.0F, 0.0F));
  add_floor_lamp(builder, m.metal, m.lamp_shade, {105.0F, 84.0F, 56.0F});
  builder.place(standing_at(room_x, 2.2F, 1.62F, -90.0F));
  add_picture(builder, 1.2F, 0.75F, 0.035F, m.pictures[0], m.walnut);
  builder.place(standing_at(room_x, 3.35F, 1.55F, -90.0F));
  add_picture(builder, 0.36F, 0.36F, 0.02F, m.pictures[2], m.black);
}

void add_dining_place(SceneBuilder& builder, const Materials& m, Random& random) {
  builder.place(standing_at(1.75F, 3.0F, 0.0F, 0.0F));
  add_table(builder, {1.4F, 0.85F, 0.75F}, 0.03F, 0.06F, m.oak, m.oak);
  builder.place(standing_at(1.75F, 3.0F, 0.75F, 20.0F));
  add_tableware(builder, m.books, m.paper, m.china, m.terracotta, random);
  const float chairs[4][3] = {{1.4F, 2.42F, 186.0F}, {2.1F, 2.36F, 172.0F}, {1.38F, 3.6F, 4.0F}, {2.12F, 3.62F, -8.0F}};
  for (const auto& c : chairs) {
    // Chairs face the table; their front is -y.
    builder.place(standing_at(c[0], c[1], 0.0F, c[2]));
    add_chair(builder, m.walnut, m.seat_cloth);
  }
  builder.place(standing_at(1.75F, 3.0F, 0.0F, 0.0F));
  builder.add_cylinder({0.0F, 0.0F, 1.82F}, {0.0F, 0.0F, room_z}, 0.004F, 0.004F, m.black, 8, false);
  builder.add_cylinder({0.0F, 0.0F, 1.60F}, {0.0F, 0.0F, 1.82F}, 0.22F, 0.05F, m.pendant, 32, false);
}

void add_walls_furniture(SceneBuilder& builder, const Materials& m, Random& random) {
  // West: books, and pictures to the left of them as one looks at the wall.
  builder.place(standing_at(0.17F, 2.75F, 0.0F, 90.0F));
  add_bookshelf(builder, {1.7F, 0.32F, 2.05F}, 6, 2, m.oak, m.books, m.paper, random);
  builder.place(standing_at(0.0F, 1.25F, 1.62F, 90.0F));
  add_picture(builder, 0.55F, 0.55F, 0.03F, m.pictures[1], m.black);
  builder.place(standing_at(0.0F, 0.62F, 1.45F, 90.0F));
  add_picture(builder, 0.30F, 0.30F, 0.02F, m.pictures[5], m.oak);
  builder.place(standing_at(0.45F, 4.12F, 0.0F, 0.0F));
  add_plant(builder, 1.25F, 16, m.terracotta, m.leaf, m.earth, random);

  // South: a sideboard with a television.
  builder.place(standing_at(4.45F, 0.23F, 0.0F, 180.0F));
  add_sideboard(builder, {1.8F, 0.42F, 0.62F}, m.walnut, m.oak, m.metal);
  builder.add_box({-0.48F, -0.02F, 0.66F}, {0.48F, 0.02F, 1.22F}, m.black);
  builder.add_quad({-0.465F, -0.0205F, 1.205F}, {0.93F, 0.0F, 0.0F}, {0.0F, 0.0F, -0.53F}, m.screen);
  builder.add_box({-0.15F, -0.09F, 0.62F}, {0.15F, 0.09F, 0.635F}, m.black);
  builder.add_box({-0.04F, -0.01F, 0.635F}, {0.04F, 0.02F, 0.67F}, m.black);
  builder.place(standing_at(5.15F, 0.24F, 0.62F, 200.0F));
  add_picture(builder, 0.13F, 0.18F, 0.012F, m.pictures[4], m.metal);
  builder.place(standing_at(3.72F, 0.24F, 0.62F, 0.0F));
  builder.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.24F}, 0.05F, 0.085F, m.china, 20, false);
  for (int i = 0; i < 7; ++i) {
    const auto a = static_cast<float>(random.uniform(0.0, 6.28));
    const auto r = static_cast<float>(random.uniform(0.05, 0.17));
    const Eigen::Vector3f top(r * std::cos(a), 0.6F * r * std::sin(a), static_cast<float>(random.uniform(0.36, 0.5)));
    builder.add_cylinder({0.0F, 0.0F, 0.12F}, top, 0.004F, 0.003F, m.leaf, 6, false);
    builder.add_cushion(top, {0.034F, 0.034F, 0.024F}, 1.0F, i % 2 == 0 ? m.fruit : m.paper, 4);
  }
  builder.place(standing_at(3.45F, 0.0F, 1.66F, 180.0F));
  add_picture(builder, 0.42F, 0.42F, 0.025F, m.pictures[3], m.walnut);
  builder.place(standing_at(5.62F, 0.42F, 0.0F, 0.0F));
  add_plant(builder, 0.95F, 12, m.terracotta, m.leaf, m.earth, random);

  // A clock and a mantel shelf on the chimney breast.
  builder.place(standing_at(2.6F, 0.32F, 0.0F, 180.0F));
  builder.add_cylinder({0.0F, 0.0F, 1.85F}, {0.0F, -0.03F, 1.85F}, 0.16F, 0.16F, m.white, 32, true);
  builder.add_box({-0.006F, -0.034F, 1.85F}, {0.006F, -0.031F, 1.97F}, m.black);
  builder.add_box({-0.004F, -0.034F, 1.845F}, {0.085F, -0.031F, 1.857F}, m.black);
  builder.add_box({-0.5F, -0.16F, 1.22F}, {0.5F, 0.0F, 1.27F}, m.oak);
  builder.add_cylinder({0.3F, -0.08F, 1.27F}, {0.3F, -0.08F, 1.45F}, 0.022F, 0.02F, m.fruit, 16, true);
  builder.add_cylinder({0.38F, -0.07F, 1.27F}, {0.38F, -0.07F, 1.40F}, 0.022F, 0.02F, m.paper, 16, true);
}

}  // namespace

Scene make_living_room(std::uint64_t seed) {
  SceneBuilder builder;
  const Materials m = make_materials(builder, seed);
  builder.set_background(outdoor_pattern(1024, 512, static_cast<std::uint32_t>(seed + 77)), 2.6F);
  Random random(seed);
  add_shell(builder, m);
  add_sitting_corner(builder, m, random);
  add_dining_place(builder, m, random);
  add_walls_furniture(builder, m, random);
  LightingOptions lighting;
  lighting.exposure = 2.3F;
  return builder.build(lighting);
}

std::vector<Waypoint> living_room_walk() {
  return {{{1.10, 1.75, 1.50}, {4.40, 0.40, 0.75}}, {{1.75, 1.50, 1.52}, {5.20, 1.40, 0.75}},
          {{2.60, 1.55, 1.46}, {5.40, 2.70, 0.80}}, {{3.15, 2.15, 1.50}, {4.50, 4.20, 0.80}},
          {{3.15, 2.50, 1.52}, {2.70, 4.50, 0.85}}, {{2.95, 2.25, 1.48}, {1.40, 3.40, 0.85}},
          {{2.70, 1.75, 1.45}, {0.50, 2.75, 0.95}}};
}

std::vector<SE3> living_room_scan_poses() {
  std::vector<SE3> poses;
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.9, 1.2, 1.4), Eigen::Vector3d(3.1, 1.3, 1.6),
                                   Eigen::Vector3d(3.1, 3.5, 1.3), Eigen::Vector3d(4.9, 0.95, 1.2)}) {
    poses.emplace_back(Eigen::Quaterniond::Identity(), p);
  }
  return poses;
}

}  // namespace odosplat
