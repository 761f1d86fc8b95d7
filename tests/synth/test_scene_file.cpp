// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string small_room = R"(
size: [3, 2, 2.5]
floor: grey
ceiling: white
walls: {west: {material: white}, east: {material: white}, south: {material: white},
  north: {material: white, windows: [{at: 1, width: 1, sill: 1, height: 1, daylight: [5, 5, 5], frame: grey}]}}
materials:
  grey: {tint: [0.5, 0.5, 0.5]}
  white: {pattern: plaster, color: [0.9, 0.9, 0.9], pixels: [32, 32]}
furniture:
  - {kind: box, at: [1, 1, 0], size: [0.4, 0.4, 0.4], materials: {all: grey}}
lidar: [[1.5, 0.5, 1.2]]
walks:
  across: {frames: 30, length_m: 0.5, waypoints: [[0.5, 0.5, 1.2, 2.5, 1.5, 1], [2.0, 0.5, 1.2, 2.5, 1.8, 1]]}
)";

LightingOptions coarse_light() {
  LightingOptions lighting;
  lighting.texel_m = 1.0F;
  lighting.light_samples = lighting.gather_samples = 1;
  lighting.bounces = 0;
  return lighting;
}

/// The text of the small room with one part replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = small_room;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    parse_scene("room.yaml", text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(SceneFile, ReadsARoom) {
  const SceneDescription scene = parse_scene("room.yaml", small_room);
  EXPECT_FLOAT_EQ(scene.size.z(), 2.5F);
  EXPECT_EQ(scene.materials.size(), 2U);
  ASSERT_EQ(scene.furniture.size(), 1U);
  EXPECT_EQ(scene.furniture[0].materials.at("all"), "grey");
  EXPECT_EQ(scene.walls[SceneDescription::north].windows.size(), 1U);
  EXPECT_EQ(scene.walk("across").options.frames, 30);
  EXPECT_EQ(scene.scan_places.size(), 1U);
}

TEST(SceneFile, ErrorsNameFileAndKey) {
  const std::vector<std::array<std::string, 3>> cases{
      {"size: [3, 2, 2.5]", "size: [3, 2]", "room.yaml: size: needs 3 numbers"},
      {"floor: grey", "floor: green", "room.yaml: floor: there is no material green"},
      {"floor: grey", "flor: grey", "room.yaml: flor: is not a known key"},
      {"ceiling: white\n", "", "room.yaml: ceiling: is missing"},
      {"pattern: plaster", "pattern: gold", "room.yaml: materials.white.pattern: must be one of plain, plaster"},
      {"color: [0.9, 0.9, 0.9], ", "", "room.yaml: materials.white.color: is missing"},
      {"tint: [0.5", "tint: [x", "room.yaml: materials.grey.tint[0]: is not a number"},
      {"tint: [0.5", "tint: [9", "room.yaml: materials.grey.tint[0]: must be in 0..4, is 9"},
      {"kind: box", "kind: bocks", "room.yaml: furniture[0].kind: must be one of box"},
      {"{all: grey}", "{al: grey}", "room.yaml: furniture[0].materials.al: is not a known key"},
      {"size: [0.4", "sice: [0.4", "room.yaml: furniture[0].sice: is not a known key"},
      {"width: 1,", "width: 3,", "room.yaml: walls.north.windows[0].width: the window ends outside its wall"},
      {"frames: 30", "frames: 2.5", "room.yaml: walks.across.frames: is not a whole number"},
      {"1.2, 2.5, 1.5, 1]", "1.2, 2.5]", "room.yaml: walks.across.waypoints[0]: needs 6 numbers"},
      {"frames: 30", "loop: true, frames: 30", "room.yaml: walks.across.waypoints: needs at least 2, or 3 for a loop"},
      {"lidar: [[", "lidar: [", "room.yaml: line"}};
  for (const auto& [from, to, error] : cases) EXPECT_THAT(error_of(changed(from, to)), HasSubstr(error));
  EXPECT_THAT(error_of("- 1\n"), HasSubstr("room.yaml: content: is not a list of `key: value`"));
}

TEST(SceneFile, NamesWhatThereIs) {
  EXPECT_THAT(built_in_scenes(), ElementsAre("living_room", "office"));
  try {
    parse_scene("room.yaml", small_room).walk("along");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "room.yaml: has no walk along: there are across");
  }
  EXPECT_THROW(built_in_scene("kitchen"), InputError);
}

TEST(SceneFile, SeedChangesTexturesAndNotShapes) {
  const SceneDescription description = parse_scene("room.yaml", small_room);
  const Scene a = make_scene(description, 1, coarse_light());
  const Scene b = make_scene(description, 2, coarse_light());
  ASSERT_EQ(a.content().triangles.size(), b.content().triangles.size());
  const Eigen::Vector2f place(0.3F, 0.3F);
  EXPECT_EQ(a.content().triangles[3].p_world, b.content().triangles[3].p_world);
  EXPECT_NE(a.content().textures[0]->sample(place, 1.0F), b.content().textures[0]->sample(place, 1.0F));
}

TEST(Office, IsClosedButForItsWindows) {
  const SceneDescription description = built_in_scene("office");
  const Scene office = make_scene(description, 1, coarse_light());
  Random random(1);
  int lost = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector3d origin(k % 2 == 0 ? 1.6 : 7.2, 2.1, 1.5);
    const Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
    RayHit hit;
    if (office.closest({origin.cast<float>(), d.cast<float>()}, hit)) continue;
    ASSERT_GT(d.y(), 0.0);
    const Eigen::Vector3d p = origin + d * (description.size.y() - origin.y()) / d.y();
    bool through_a_window = false;
    for (const WindowDescription& w : description.walls[SceneDescription::north].windows) {
      through_a_window |= p.x() > w.at && p.x() < w.at + w.width && p.z() > w.sill && p.z() < w.sill + w.height;
    }
    EXPECT_TRUE(through_a_window) << p.transpose();
    ++lost;
  }
  EXPECT_GT(lost, 50);
  EXPECT_LT(lost, 2000);
}

}  // namespace
}  // namespace odosplat
