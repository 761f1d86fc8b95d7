// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "odosplat/splat/map_file.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;

class MapFormats : public testing::Test {
 protected:
  void SetUp() override {
    Gaussians g;
    g.sh_degree = 1;
    g.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      g.positions[3 * i] = static_cast<float>(i) + 0.25F;
      g.rotations[4 * i] = 1.0F;
      g.log_scales[3 * i] = g.log_scales[3 * i + 1] = g.log_scales[3 * i + 2] = -2.0F;
    }
    write_map(map_, g, {"blend_order distance", "sigma_spread 0.7"});
  }
  std::string path(const std::string& name) const { return scratch_ / name; }

  ScratchFolder scratch_;
  std::string map_ = path("m.ply");
};

TEST_F(MapFormats, ConvertGoesThroughAllThatAreWritten) {
  std::string from = map_;
  for (const char* name : {"a.glb", "b.spz", "c.ply"}) {
    const RunResult run = run_odosplat({"convert", from, path(name)});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("3 Gaussians"));
    from = path(name);
    const RunResult info = run_odosplat({"map", "info", from});
    EXPECT_THAT(info.out, HasSubstr("blend order   distance"));
    EXPECT_THAT(info.out, HasSubstr("sigma         spread 0.7"));
  }
  EXPECT_EQ(read_map(path("c.ply")).gaussians.positions, read_map(map_).gaussians.positions);
}

TEST_F(MapFormats, FaultsEndWith2AndLeaveNothing) {
  EXPECT_THAT(run_odosplat({"convert", map_, path("a.sog")}).err,
              HasSubstr("must end in .ply or .splat or .spz or .glb"));
  ASSERT_EQ(run_odosplat({"convert", map_, path("a.spz")}).status, 0);
  std::filesystem::resize_file(path("a.spz"), 60);
  const RunResult cut = run_odosplat({"convert", path("a.spz"), path("b.ply")});
  EXPECT_EQ(cut.status, 2);
  EXPECT_THAT(cut.err, HasSubstr("a.spz: header: is cut off"));
  write_text(path("cloud.xyz"), "1 2 3\n4 5 6\n");
  const RunResult cloud = run_odosplat({"convert", path("cloud.xyz"), path("b.glb")});
  EXPECT_EQ(cloud.status, 2);
  EXPECT_THAT(cloud.err, HasSubstr("holds no Gaussians, which .glb is made of"));
  EXPECT_FALSE(std::filesystem::exists(path("b.ply")) || std::filesystem::exists(path("b.glb")));
}

TEST_F(MapFormats, HelpNamesThem) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"convert", "--help"}, {"track", "--help"}}) {
    const std::string help = run_odosplat(words).out;
    for (const char* name : {".spz", ".glb", ".sog", ".splat"}) EXPECT_THAT(help, HasSubstr(name)) << words[0];
  }
}

}  // namespace
}  // namespace odosplat::apps_test
