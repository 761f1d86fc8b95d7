// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Runs of train that are stopped, taken up again, or given what training must refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "odosplat/core/random.hpp"
#include "odosplat/io/cloud_file.hpp"
#include "run_program.hpp"
#include "tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Training : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", 24);
    const RunResult made =
        run_odosplat({"cloud", sequence_, "--every", "3", "--voxel", "0.05", "--noise", "0.002", "--out", cloud_});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  std::vector<std::string> words(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"train",
                                 sequence_,
                                 "--every",
                                 "3",
                                 "--cloud",
                                 cloud_,
                                 "--out",
                                 out,
                                 "--iterations",
                                 "120",
                                 "--checkpoint-every",
                                 "10"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string cloud_ = scratch_ / "cloud.ply";
};

TEST_F(Training, KilledRunsEndWithTheSameBits) {
  const std::string whole = scratch_ / "whole.ply";
  ASSERT_EQ(run_odosplat(words(whole, {"--densify", "relocate", "--budget", "9000"})).status, 0);
  EXPECT_FALSE(fs::exists(whole + ".checkpoint"));

  Random random(7);
  const std::string map = scratch_ / "killed.ply";
  const std::string checkpoint = map + ".checkpoint";
  const auto flags = words(map, {"--densify", "relocate", "--budget", "9000", "--resume"});
  int kills = 0;
  RunResult last;
  for (int attempt = 0; attempt < 5; ++attempt) {
    // Once a newer checkpoint than the last run's is there, after a while of up to a few steps.
    const auto before = fs::exists(checkpoint) ? fs::last_write_time(checkpoint) : fs::file_time_type::min();
    long wait = static_cast<long>(random.uniform(0.0, 20.0));
    last = run_odosplat_and_signal(flags, SIGKILL, [&] {
      std::error_code ignored;
      const auto now = fs::last_write_time(checkpoint, ignored);
      return !ignored && now > before && --wait < 0;
    });
    if (last.status == 0) break;
    ASSERT_EQ(last.status, 128 + SIGKILL) << last.err;
    EXPECT_FALSE(fs::exists(map));
    ++kills;
  }
  EXPECT_GE(kills, 2);
  if (last.status != 0) last = run_odosplat(flags);
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("going on from iteration"));
  EXPECT_FALSE(fs::exists(checkpoint));
  EXPECT_TRUE(read_text(map) == read_text(whole)) << "the map of the run that was killed " << kills << " times differs";
}

TEST_F(Training, CtrlCSavesAndExitsWith130) {
  const std::string map = scratch_ / "map.ply";
  const std::string checkpoint = map + ".checkpoint";
  const RunResult stopped = run_odosplat_and_signal(words(map), SIGINT, [&] { return fs::exists(checkpoint); });
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_TRUE(fs::exists(map));
  EXPECT_TRUE(fs::exists(checkpoint));
  const RunResult resumed = run_odosplat(words(map, {"--resume"}));
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  const std::string whole = scratch_ / "whole.ply";
  ASSERT_EQ(run_odosplat(words(whole)).status, 0);
  EXPECT_TRUE(read_text(map) == read_text(whole));
}

TEST_F(Training, ForeignAndDamagedCheckpointsAreRefused) {
  const std::string map = scratch_ / "map.ply";
  write_text(map + ".checkpoint", "not a checkpoint");
  const RunResult damaged = run_odosplat(words(map, {"--resume"}));
  EXPECT_EQ(damaged.status, 2);
  EXPECT_THAT(damaged.err, HasSubstr("map.ply.checkpoint"));

  fs::remove(map + ".checkpoint");
  const RunResult stopped =
      run_odosplat_and_signal(words(map), SIGKILL, [&] { return fs::exists(map + ".checkpoint"); });
  ASSERT_EQ(stopped.status, 128 + SIGKILL);
  const RunResult other = run_odosplat(words(map, {"--resume", "--depth-weight", "0.3"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("depth_weight"));
  EXPECT_FALSE(fs::exists(map));
}

TEST_F(Training, CloudWithoutColoursTakesThemFromTheImages) {
  PointCloud cloud = read_point_cloud(cloud_);
  cloud.colors.clear();
  const std::string bare = scratch_ / "bare.ply";
  write_point_cloud(bare, cloud);
  // Before any step: what the images painted on the points, against what the cloud itself knew.
  for (const std::string& source : {cloud_, bare}) {
    const std::string map = source + ".map.ply";
    ASSERT_EQ(
        run_odosplat({"train", sequence_, "--every", "3", "--cloud", source, "--out", map, "--iterations", "0"}).status,
        0);
    const RunResult judged = run_odosplat(
        {"eval-depth", sequence_, "--map", map, "--every", "2", "--skip-every", "3", "--json", map + ".json"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    EXPECT_GT(nlohmann::json::parse(read_text(map + ".json"))["psnr_db"], 17.0) << source;
  }
}

TEST_F(Training, EveryChoiceTrains) {
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--densify", "split"}, {"--exposure", "on"}, {"--sh-degree", "3"}, {"--preset", "paper"}}) {
    const std::string map = scratch_ / "map.ply";
    const RunResult result = run_odosplat(words(map, more));
    EXPECT_EQ(result.status, 0) << testing::PrintToString(more) << result.err;
    EXPECT_EQ(run_odosplat({"eval-depth", sequence_, "--map", map, "--skip-every", "3"}).status, 0);
  }
  EXPECT_EQ(run_odosplat(words(scratch_ / "map.ply", {"--densify", "more"})).status, 2);
  EXPECT_EQ(run_odosplat(words(scratch_ / "map.ply", {"--exposure", "often"})).status, 2);
}

}  // namespace
}  // namespace odosplat::apps_test
