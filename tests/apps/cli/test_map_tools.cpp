// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "odosplat/splat/map_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;

/// A map of the tiny sequence (its room: x 0..4, y 0..3, z 0..2.5 m), as its cloud has it.
class MapTools : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", 24);
    const std::string cloud = scratch_ / "cloud.ply";
    ASSERT_EQ(run_odosplat({"cloud", sequence_, "--voxel", "0.05", "--out", cloud}).status, 0);
    const RunResult made =
        run_odosplat({"train", sequence_, "--every", "3", "--cloud", cloud, "--iterations", "0", "--out", map_});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  RunResult map_tool(std::vector<std::string> words) {
    words.insert(words.begin(), "map");
    return run_odosplat(words);
  }
  std::string at(const std::string& name) { return scratch_ / name; }
  std::size_t size_of(const std::string& map) { return read_map(map).gaussians.size(); }
  nlohmann::json info_of(const std::string& map) {
    EXPECT_EQ(map_tool({"info", map, "--json", at("info.json")}).status, 0);
    return nlohmann::json::parse(read_text(at("info.json")));
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string map_ = scratch_ / "map.ply";
};

TEST_F(MapTools, InfoSaysHowLargeAndFromWhat) {
  const auto info = info_of(map_);
  EXPECT_NEAR(info["spacing_m"], 0.05, 0.02);
  EXPECT_EQ(info["flat_share"], 1.0);
  EXPECT_GE(info["middle_m"]["least"][0], info["bounds_m"]["least"][0]);
  EXPECT_LE(info["middle_m"]["most"][2], info["bounds_m"]["most"][2]);
  ASSERT_EQ(info["trained_on"].size(), 1U);
  EXPECT_EQ(info["trained_on"][0], "one in 3 of frames 0 to 23 of seq (24 frames)");
  EXPECT_TRUE(info["edits"].empty());
}

TEST_F(MapTools, CropsByBox) {
  const std::vector<std::string> box{"--box", "-9 -9 -9 3.2 9 9", "--out"};
  const RunResult in = map_tool({"crop", map_, box[0], box[1], box[2], at("in.ply")});
  ASSERT_EQ(in.status, 0) << in.err;
  EXPECT_THAT(in.out, HasSubstr(" Gaussians kept ("));
  ASSERT_EQ(map_tool({"crop", map_, "--outside", box[0], box[1], box[2], at("out.ply")}).status, 0);
  EXPECT_EQ(size_of(at("in.ply")) + size_of(at("out.ply")), size_of(map_));
  EXPECT_LE(info_of(at("in.ply"))["bounds_m"]["most"][0], 3.2);
  EXPECT_THAT(std::string(info_of(at("out.ply"))["edits"][0]), HasSubstr("crop: outside of box -9 -9 -9 3.2 9 9, "));
  EXPECT_EQ(info_of(at("in.ply"))["places"], info_of(map_)["places"]);
  // A line break in the flag is none in the header.
  ASSERT_EQ(map_tool({"crop", map_, "--box", "-9 -9 -9\n3.2 9,9", "--out", at("lines.ply")}).status, 0);
  EXPECT_THAT(std::string(info_of(at("lines.ply"))["edits"][0]), HasSubstr("crop: inside of box -9 -9 -9 3.2 9 9, "));
  // The same box, described on axes that are turned by 90 degrees about z.
  const RunResult turned = map_tool(
      {"crop", map_, "--box", "-9 -3.2 -9 9 9 9", "--T", "0 0 0 0 0 0.70710678 0.70710678", "--out", at("turned.ply")});
  ASSERT_EQ(turned.status, 0) << turned.err;
  EXPECT_EQ(size_of(at("turned.ply")), size_of(at("in.ply")));
}

TEST_F(MapTools, CropRefusesWhatMakesNoSense) {
  const auto crop = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"crop", map_, "--out", at("x.ply")});
    return map_tool(words);
  };
  const RunResult empty = crop({"--box", "50 50 50 51 51 51"});
  EXPECT_EQ(empty.status, 3);
  EXPECT_THAT(empty.err, HasSubstr("none of its"));
  EXPECT_EQ(crop({}).status, 2);
  EXPECT_THAT(crop({"--box", "0 0 0 1 1"}).err, HasSubstr("--box: must be"));
  EXPECT_THAT(crop({"--box", "0 0 0 0 1 1"}).err, HasSubstr("--box: "));
  EXPECT_THAT(crop({"--box", "0 0 0 1 1 x"}).err, HasSubstr("--box: must be"));
  EXPECT_THAT(crop({"--box", "0 0 0 1 1 1", "--T", "0 0 0 0 0 0 9"}).err, HasSubstr("--T: the quaternion"));
  EXPECT_EQ(crop({"--box", "0 0 0 1 1 1", "--margin", "1"}).status, 2);
  EXPECT_EQ(crop({"--outside", "--seen-by", sequence_}).status, 2);
  const RunResult no_camera = crop({"--seen-by", sequence_ + "/groundtruth.txt"});
  EXPECT_EQ(no_camera.status, 2);
  EXPECT_THAT(no_camera.err, HasSubstr("--camera"));
  std::string reflected = read_text(sequence_ + "/camera.yaml");
  const std::size_t fy = reflected.find("fy:");
  ASSERT_NE(fy, std::string::npos);
  reflected.insert(reflected.find_first_not_of(' ', fy + 3), "-");
  write_text(at("reflected.yaml"), reflected);
  const RunResult mirror = crop({"--seen-by", sequence_ + "/groundtruth.txt", "--camera", at("reflected.yaml")});
  EXPECT_EQ(mirror.status, 2);
  EXPECT_THAT(mirror.err, HasSubstr("reflected.yaml: has a negative fy"));
  EXPECT_FALSE(std::filesystem::exists(at("x.ply")));
}

TEST_F(MapTools, CropsByWhatIsSeenTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(map_tool({"crop", map_, "--seen-by", sequence_, "--every", "24", "--out", at("one.ply")}).status, 0);
  const RunResult poses =
      map_tool({"crop", map_, "--seen-by", sequence_ + "/groundtruth.txt", "--camera", sequence_ + "/camera.yaml",
                "--every", "24", "--threads", "1", "--out", at("poses.ply")});
  ASSERT_EQ(poses.status, 0) << poses.err;
  EXPECT_LT(size_of(at("one.ply")), size_of(map_));
  EXPECT_EQ(read_map(at("one.ply")).gaussians.positions, read_map(at("poses.ply")).gaussians.positions);
  ASSERT_EQ(
      map_tool({"crop", map_, "--seen-by", sequence_, "--every", "24", "--margin", "0.2", "--out", at("wide.ply")})
          .status,
      0);
  EXPECT_GT(size_of(at("wide.ply")), size_of(at("one.ply")));
  EXPECT_THAT(std::string(info_of(at("wide.ply"))["edits"][0]), HasSubstr("seen by seq (1 view), margin 0.2 m"));
}

TEST_F(MapTools, MergesPartsToTheWhole) {
  ASSERT_EQ(map_tool({"crop", map_, "--box", "-9 -9 -9 3.4 9 9", "--out", at("a.ply")}).status, 0);
  ASSERT_EQ(map_tool({"crop", map_, "--box", "3.0 -9 -9 9 9 9", "--out", at("b.ply")}).status, 0);
  const RunResult merged = map_tool({"merge", at("a.ply"), at("b.ply"), "--out", at("ab.ply"), "--threads", "1"});
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("quality not measured"));
  const auto n = static_cast<double>(size_of(map_));
  EXPECT_NEAR(static_cast<double>(size_of(at("ab.ply"))), n, 0.01 * n);
  ASSERT_EQ(map_tool({"merge", at("a.ply"), at("b.ply"), "--out", at("again.ply"), "--threads", "3"}).status, 0);
  EXPECT_EQ(read_text(at("ab.ply")), read_text(at("again.ply")));
  const auto info = info_of(at("ab.ply"));
  EXPECT_EQ(info["sources"].size(), 2U);
  EXPECT_EQ(info["trained_on"].size(), 1U);
  EXPECT_THAT(std::string(info["edits"].back()), HasSubstr("merge: "));
  // A map that was merged is a map like any other.
  EXPECT_EQ(map_tool({"merge", at("ab.ply"), at("b.ply"), "--out", at("abb.ply")}).status, 0);
  EXPECT_EQ(map_tool({"merge", at("a.ply"), "--out", at("x.ply")}).status, 2);
  EXPECT_EQ(map_tool({"merge", at("a.ply"), at("b.ply"), "--out", at("b.ply")}).status, 2);
}

TEST_F(MapTools, MergeRefusesAnotherFrame) {
  Map off = read_map(map_);
  for (std::size_t i = 1; i < off.gaussians.positions.size(); i += 3) off.gaussians.positions[i] += 0.08F;
  for (std::size_t i = 0; i < off.gaussians.positions.size(); i += 3) off.gaussians.positions[i] += 0.08F;
  write_map(at("off.ply"), off);
  const RunResult refused = map_tool({"merge", map_, at("off.ply"), "--out", at("x.ply")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("different frames (run align)"));
  EXPECT_FALSE(std::filesystem::exists(at("x.ply")));
  const RunResult forced = map_tool({"merge", map_, at("off.ply"), "--force", "--out", at("x.ply")});
  EXPECT_EQ(forced.status, 0);
  EXPECT_THAT(forced.err, HasSubstr("different frames"));
}

TEST_F(MapTools, CleansAndCountsByReason) {
  Map dirty = read_map(map_);
  const std::size_t good = dirty.gaussians.size();
  dirty.gaussians.resize(good + 2);
  for (std::size_t i = good; i < good + 2; ++i) {
    const float place[3] = {2.4F, 1.4F, 1.7F};
    for (std::size_t a = 0; a < 3; ++a) {
      dirty.gaussians.positions[3 * i + a] = place[a];
      dirty.gaussians.log_scales[3 * i + a] = -3.5F;
    }
    dirty.gaussians.rotations[4 * i] = 1.0F;
    dirty.gaussians.opacity_logits[i] = i == good ? 2.0F : -6.0F;
  }
  write_map(at("dirty.ply"), dirty);
  for (const bool seen : {false, true}) {
    std::vector<std::string> words{"clean", at("dirty.ply"), "--out", at("clean.ply")};
    if (seen) words.insert(words.end(), {"--seen-by", sequence_});
    const RunResult cleaned = map_tool(words);
    ASSERT_EQ(cleaned.status, 0) << cleaned.err;
    EXPECT_THAT(cleaned.out, HasSubstr("almost transparent 1"));
    EXPECT_LE(size_of(at("clean.ply")), good);
    EXPECT_GE(size_of(at("clean.ply")), good * 99 / 100);
    EXPECT_THAT(std::string(info_of(at("clean.ply"))["edits"][0]), HasSubstr("clean: 1 almost transparent, "));
  }
}

TEST_F(MapTools, CleanWarnsWhereMuchIsIsolated) {
  Map sparse = read_map(map_);
  const std::size_t good = sparse.gaussians.size();
  const std::size_t count = good / 50;
  sparse.gaussians.resize(good + count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place[3] = {k % 5, k / 5 % 5, k / 25};
    for (std::size_t a = 0; a < 3; ++a) {
      sparse.gaussians.positions[3 * (good + k) + a] = 10.0F + 2.0F * static_cast<float>(place[a]);
      sparse.gaussians.log_scales[3 * (good + k) + a] = -3.5F;
    }
    sparse.gaussians.rotations[4 * (good + k)] = 1.0F;
    sparse.gaussians.opacity_logits[good + k] = 2.0F;
  }
  write_map(at("sparse.ply"), sparse);
  const RunResult cleaned = map_tool({"clean", at("sparse.ply"), "--out", at("clean.ply")});
  ASSERT_EQ(cleaned.status, 0) << cleaned.err;
  EXPECT_THAT(cleaned.err, HasSubstr("sparse, distant surfaces may be among them"));
  EXPECT_EQ(map_tool({"clean", map_, "--out", at("good.ply")}).err.find("sparse, distant"), std::string::npos);
}

}  // namespace
}  // namespace odosplat::apps_test
