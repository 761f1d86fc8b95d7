// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Every long command ends within a second after Ctrl-C and leaves no incomplete file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class InterruptedCommands : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", 24);
    ASSERT_EQ(run_odosplat({"cloud", sequence_, "--every", "3", "--voxel", "0.05", "--out", cloud_}).status, 0);
    ASSERT_EQ(run_odosplat({"train", sequence_, "--every", "3", "--cloud", cloud_, "--iterations", "20", "--out", map_})
                  .status,
              0);
    // Poses: the sequence's path, repeated for many minutes. Places: no two of them near each other.
    const Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
    Trajectory poses;
    Trajectory places;
    for (int k = 0; k < 20000; ++k) {
      poses.push_back({k / 30.0, truth[static_cast<std::size_t>(k) % truth.size()].T_world_camera, ""});
    }
    for (int k = 0; k < 900; ++k) {
      const SE3 away(so3_exp({0.0, 0.2 * (k % 30), 0.0}), Eigen::Vector3d(0.01 * (k / 30), 0.0, 0.0));
      places.push_back({k / 30.0, truth[0].T_world_camera * away, ""});
    }
    write_trajectory(poses_, poses);
    write_trajectory(places_, places);
  }

  /// Sends Ctrl-C a second after the start, when the command is working.
  void expect_to_end(const std::vector<std::string>& words) {
    SCOPED_TRACE(testing::PrintToString(words));
    const Clock::time_point start = Clock::now();
    Clock::time_point signalled;
    const RunResult run = run_odosplat_and_signal(words, SIGINT, [&] {
      signalled = Clock::now();
      return seconds_since(start) > 1.0;
    });
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr("interrupted"));
    // The requirement is one second; the rest allows for other load of the machine.
    EXPECT_LT(seconds_since(signalled), 3.0);
    for (const auto& entry : fs::recursive_directory_iterator(scratch_.path())) {
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    }
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string camera_ = scratch_ / "seq/camera.yaml";
  std::string cloud_ = scratch_ / "cloud.ply";
  std::string map_ = scratch_ / "map.ply";
  std::string poses_ = scratch_ / "poses.txt";
  std::string places_ = scratch_ / "places.txt";
};

TEST_F(InterruptedCommands, ThatRenderImages) {
  expect_to_end({"render", "--map", map_, "--poses", poses_, "--camera", camera_, "--out", scratch_ / "images"});
}

TEST_F(InterruptedCommands, ThatMakeAFilm) {
  const fs::path film = scratch_ / "film.avi";
  expect_to_end({"view", "fly", "--map", map_, "--poses", poses_, "--camera", camera_, "--out", film});
  EXPECT_FALSE(fs::exists(film));
}

TEST_F(InterruptedCommands, ThatLookImagesUp) {
  const fs::path found = scratch_ / "found.txt";
  expect_to_end({"relocalise", sequence_, "--map", map_, "--places", places_, "--out", found});
  EXPECT_FALSE(fs::exists(found));
}

TEST_F(InterruptedCommands, ThatMakeSequences) {
  expect_to_end({"synthesize", "--scene", "living_room", "--walk", "icl_1", "--out", scratch_ / "walk"});
  expect_to_end({"demo", "--out", scratch_ / "demo", "--frames", "2000"});
}

TEST_F(InterruptedCommands, ThatRunOthers) {
  expect_to_end({"benchmark", "--suite", "synthetic", "--out", scratch_ / "results"});
}

}  // namespace
}  // namespace odosplat::apps_test
