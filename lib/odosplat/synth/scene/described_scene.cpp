// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/error.hpp"
#include "odosplat/synth/content/furniture.hpp"
#include "odosplat/synth/content/patterns.hpp"
#include "odosplat/synth/scene/catalogue.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {
namespace {

using MaterialIndices = std::map<std::string, std::vector<int>>;

template <class Row>
const Row& row_named(const std::vector<Row>& rows, const std::string& name) {
  for (const Row& row : rows) {
    if (row.name == name) return row;
  }
  throw InputError("scene", name + " is not known");
}

/// Adds all variants of a material; returns their indices.
std::vector<int> add_variants(SceneBuilder& builder, const MaterialDescription& description, std::uint32_t seed) {
  const PatternRow& pattern = row_named(material_patterns(), description.pattern);
  const Parameters p(description.numbers);
  const std::vector<Eigen::Vector3f> tints = p.triples("tints");
  Random random(seed);
  std::vector<int> variants;
  for (int i = 0; i < p.integer("count"); ++i) {
    Material material;
    material.tint = p.triple("tint");
    if (!tints.empty()) {
      material.tint =
          tints[random.below(static_cast<std::uint32_t>(tints.size()))] * static_cast<float>(random.uniform(0.85, 1.1));
    }
    material.gloss = p.number("gloss");
    material.emission = p.number("emission");
    material.casts_shadow = p.integer("shadow") != 0;
    material.fit = pattern.fit;
    if (pattern.paint) {
      const Eigen::Vector2f pixels = p.pair("pixels");
      const auto own = seed + 7919U * static_cast<std::uint32_t>(i);
      const ColorImage image = pattern.paint(p, static_cast<int>(pixels.x()), static_cast<int>(pixels.y()), own);
      const Texture::Edge edge = pattern.fit ? Texture::Edge::clamp : Texture::Edge::repeat;
      material.texture = builder.add_texture(image, p.pair("size"), edge);
    }
    variants.push_back(builder.add_material(material));
  }
  return variants;
}

/// Length of a wall and its frame: x to the right as seen from inside the room, which is at -y.
struct WallFrame {
  float length;
  Eigen::Isometry3f T_world_wall;
};

WallFrame frame_of(std::size_t wall, const Eigen::Vector3f& size) {
  switch (wall) {
    case SceneDescription::west:
      return {size.y(), standing_at(0.0F, 0.0F, 0.0F, 90.0F)};
    case SceneDescription::east:
      return {size.y(), standing_at(size.x(), size.y(), 0.0F, -90.0F)};
    case SceneDescription::south:
      return {size.x(), standing_at(size.x(), 0.0F, 0.0F, 180.0F)};
    default:
      return {size.x(), standing_at(0.0F, size.y(), 0.0F, 0.0F)};
  }
}

void add_wall(SceneBuilder& builder, const WallDescription& wall, const WallFrame& frame, float height,
              const MaterialIndices& materials) {
  const int material = materials.at(wall.material)[0];
  // A piece of the wall, x0..x1 and z0..z1. The texture continues from piece to piece.
  auto add_piece = [&](float x0, float x1, float z0, float z1) {
    builder.place(frame.T_world_wall);
    builder.add_quad({x0, 0.0F, z1}, {x1 - x0, 0.0F, 0.0F}, {0.0F, 0.0F, z0 - z1}, material, {x0, height - z1});
  };
  float from = 0.0F;
  for (const WindowDescription& w : wall.windows) {
    const float to = w.at + w.width;
    add_piece(from, w.at, 0.0F, height);
    add_piece(w.at, to, 0.0F, w.sill);
    add_piece(w.at, to, w.sill + w.height, height);
    Eigen::Isometry3f T_world_window = frame.T_world_wall;
    T_world_window.translate(Eigen::Vector3f(w.at, 0.0F, w.sill));
    builder.place(T_world_window);
    add_window(builder, w.width, w.height, w.depth, material, materials.at(w.frame)[0], w.daylight);
    from = to;
  }
  add_piece(from, frame.length, 0.0F, height);
}

void add_shell(SceneBuilder& builder, const SceneDescription& scene, const MaterialIndices& materials) {
  builder.place(Eigen::Isometry3f::Identity());
  const Eigen::Vector3f dx(scene.size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f dy(0.0F, scene.size.y(), 0.0F);
  const Eigen::Vector3f dz(0.0F, 0.0F, scene.size.z());
  builder.add_quad(dy, dx, -dy, materials.at(scene.floor)[0]);
  builder.add_quad(dz, dx, dy, materials.at(scene.ceiling)[0]);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const WallFrame frame = frame_of(i, scene.size);
    add_wall(builder, scene.walls[i], frame, scene.size.z(), materials);
    if (scene.skirting.empty()) continue;
    builder.place(frame.T_world_wall);
    builder.add_box({0.0F, -0.015F, 0.0F}, {frame.length, 0.0F, 0.09F}, materials.at(scene.skirting)[0]);
  }
}

}  // namespace

Scene make_scene(const SceneDescription& description, std::uint64_t seed, LightingOptions lighting) {
  SceneBuilder builder;
  auto s = static_cast<std::uint32_t>(seed * 1013 + 17);
  builder.set_background(outdoor_pattern(1024, 512, s), description.sky_radiance);
  MaterialIndices materials;
  for (const MaterialDescription& m : description.materials) {
    s += 101;
    materials[m.name] = add_variants(builder, m, s);
  }
  add_shell(builder, description, materials);
  Random random(seed);
  for (const FurnitureDescription& thing : description.furniture) {
    FurnitureParts parts{Parameters(thing.numbers), {}};
    for (const auto& [place, name] : thing.materials) parts.materials[place] = materials.at(name);
    builder.place(standing_at(thing.at.x(), thing.at.y(), thing.at.z(), thing.turn_deg));
    row_named(furniture_kinds(), thing.kind).add(builder, parts, random);
  }
  lighting.exposure = description.exposure;
  return builder.build(lighting);
}

std::vector<SE3> scan_poses(const SceneDescription& description) {
  std::vector<SE3> poses;
  for (const Eigen::Vector3d& place : description.scan_places) {
    poses.emplace_back(Eigen::Quaterniond::Identity(), place);
  }
  return poses;
}

Scene make_living_room(std::uint64_t seed) { return make_scene(built_in_scene("living_room"), seed); }

std::vector<Waypoint> living_room_walk() { return built_in_scene("living_room").walk("demo").waypoints; }

std::vector<SE3> living_room_scan_poses() { return scan_poses(built_in_scene("living_room")); }

}  // namespace odosplat
