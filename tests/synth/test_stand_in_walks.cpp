// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The eight walks that replace the sequences of the paper's Table 1.
#include <gtest/gtest.h>

#include <string>

#include "odosplat/synth/motion/clearance.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat {
namespace {

struct Row {
  const char* scene;
  const char* walk;
  int frames;
  double length_m;
};

const Row table_1[] = {{"living_room", "icl_1", 1510, 6.54},  {"living_room", "icl_2", 967, 2.05},
                       {"living_room", "icl_3", 882, 8.43},   {"living_room", "icl_4", 1242, 11.32},
                       {"living_room", "augm_1", 2830, 37.2}, {"living_room", "augm_2", 2350, 36.8},
                       {"office", "augm_3", 2690, 32.1},      {"office", "augm_4", 2538, 38.1}};

const Scene& coarse_scene(const std::string& name) {
  auto make = [](const char* scene) {
    LightingOptions lighting;
    lighting.texel_m = 1.0F;
    lighting.light_samples = lighting.gather_samples = 1;
    lighting.bounces = 0;
    return make_scene(built_in_scene(scene), 1, lighting);
  };
  static const Scene living_room = make("living_room");
  static const Scene office = make("office");
  return name == "office" ? office : living_room;
}

class StandInWalks : public ::testing::TestWithParam<Row> {};

TEST_P(StandInWalks, HaveFramesLengthAndPaceOfTheTable) {
  const Row row = GetParam();
  const WalkDescription walk = built_in_scene(row.scene).walk(row.walk);
  const Trajectory path = Walk(walk.waypoints, walk.options).trajectory();
  EXPECT_EQ(path.size(), static_cast<std::size_t>(row.frames));
  EXPECT_NEAR(path.back().time, (row.frames - 1) / 30.0, 1e-9);
  EXPECT_NEAR(travelled_length(path), row.length_m, 0.02 * row.length_m);
  double turn = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    turn = std::max(turn, (path[k - 1].T_world_camera.inverse() * path[k].T_world_camera).angle() * 180.0 / M_PI);
  }
  EXPECT_LE(turn, 3.0);
  RecordProperty("turn", std::to_string(turn));
}

TEST_P(StandInWalks, KeepClearOfFurnitureAndWalls) {
  const Row row = GetParam();
  const WalkDescription walk = built_in_scene(row.scene).walk(row.walk);
  const Trajectory path = Walk(walk.waypoints, walk.options).trajectory();
  const Clearance nearest = clearance(coarse_scene(row.scene), path);
  EXPECT_GT(nearest.distance, 0.15) << "frame " << nearest.frame << ": "
                                    << path[nearest.frame].T_world_camera.translation().transpose();
}

INSTANTIATE_TEST_SUITE_P(Table1, StandInWalks, ::testing::ValuesIn(table_1),
                         [](const auto& row) { return std::string(row.param.walk); });

}  // namespace
}  // namespace odosplat
