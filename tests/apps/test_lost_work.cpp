// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Unreadable files and runs that end early lose no more of the results than necessary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class LostWork : public testing::Test {
 protected:
  static constexpr int frames = 30;

  LostWork() { write_tiny_sequence(sequence_, frames); }

  std::string image(const char* folder, int k) const {
    char name[32];
    std::snprintf(name, sizeof(name), "/%s/%04d.png", folder, k);
    return sequence_ + name;
  }
  void cut(const std::string& file) const { write_text(file, read_text(file).substr(0, 1000)); }
  std::vector<std::string> track(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"track", sequence_, "--method", "rgbd", "--out", out_};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::vector<std::string> status() const { return lines_of(read_text(out_ + "/status.csv")); }
  nlohmann::json report() const { return nlohmann::json::parse(read_text(out_ + "/report.json")); }

  ScratchFolder scratch_;
  const std::string sequence_ = scratch_ / "seq";
  const std::string out_ = scratch_ / "run";
};

TEST_F(LostWork, ADamagedImageIsALostFrame) {
  cut(image("rgb", 12));
  cv::Mat3b small(60, 80, cv::Vec3b(9, 9, 9));
  write_rgb8(image("rgb", 20), small);
  cut(image("depth", 25));
  for (const bool realtime : {false, true}) {
    const RunResult run =
        run_odosplat(track(realtime ? std::vector<std::string>{"--realtime"} : std::vector<std::string>{}));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("frame 12 is lost: " + image("rgb", 12)));
    if (realtime) continue;  // there the dropped frames depend on timing
    EXPECT_THAT(run.err, HasSubstr("3 of 30 frames cannot be read"));
    const std::vector<std::string> rows = status();
    ASSERT_EQ(rows.size(), frames + 1U);
    EXPECT_THAT(rows[0], testing::EndsWith(",in_map,confirmed,reason,latency_ms"));
    EXPECT_THAT(rows[13], testing::AllOf(HasSubstr(",lost,0,"), HasSubstr("0012.png")));
    EXPECT_THAT(rows[21], testing::AllOf(HasSubstr(",lost,0,"), HasSubstr("0020.png")));
    EXPECT_THAT(rows[26], testing::AllOf(HasSubstr(",lost,0,"), HasSubstr("0025.png")));
    EXPECT_THAT(rows[14], testing::AllOf(HasSubstr(",ok,"), testing::EndsWith(",")));
    EXPECT_EQ(read_trajectory(out_ + "/trajectory.txt").size(), frames - 3U);
    EXPECT_EQ(read_trajectory(out_ + "/trajectory_live.txt").size(), frames - 3U);
    EXPECT_EQ(report()["frames"], frames);
    EXPECT_EQ(report()["lost"], 3);
    EXPECT_EQ(report()["unreadable"], 3);
    EXPECT_EQ(report()["finished"], true);
  }
}

TEST_F(LostWork, TheFirstImageThatIsReadStartsAtItsOwnPose) {
  for (int k = 0; k < 5; ++k) cut(image("rgb", k));
  const RunResult run = run_odosplat(track());
  ASSERT_EQ(run.status, 0) << run.err;
  const Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
  const Trajectory estimate = read_trajectory(out_ + "/trajectory.txt");
  ASSERT_EQ(estimate.size(), frames - 5U);
  EXPECT_NEAR(estimate[0].time, truth[5].time, 1e-6);
  EXPECT_LT((estimate[0].T_world_camera.translation() - truth[5].T_world_camera.translation()).norm(), 0.005);
}

TEST_F(LostWork, NoImageThatCanBeReadIsBadInput) {
  for (int k = 0; k < frames; ++k) cut(image("rgb", k));
  const RunResult run = run_odosplat(track({"--log", "off"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(lines_of(run.err).size(), 1U) << run.err;
  EXPECT_THAT(run.err, HasSubstr(image("rgb", 0)));
  EXPECT_FALSE(std::filesystem::exists(out_ + "/status.csv"));
}

TEST_F(LostWork, ADamagedImageAmongManyIsLeftOutOfACloud) {
  cut(image("rgb", 10));
  cut(image("depth", 20));
  const std::vector<std::string> words{"cloud", sequence_, "--every", "5", "--out", scratch_ / "cloud.ply"};
  const RunResult run = run_odosplat(words);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(image("rgb", 10)));
  EXPECT_THAT(run.err, HasSubstr("2 of 6 frames cannot be read"));
  for (int k = 0; k < frames; k += 5) cut(image("depth", k));
  std::filesystem::remove(scratch_ / "cloud.ply");
  const RunResult none = run_odosplat(words);
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr(image("depth", 0)));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "cloud.ply"));
}

TEST_F(LostWork, ADamagedOrMissingImageAmongManyIsLeftOutOfTraining) {
  const std::string cloud = scratch_ / "cloud.ply";
  ASSERT_EQ(run_odosplat({"cloud", sequence_, "--every", "5", "--voxel", "0.05", "--out", cloud}).status, 0);
  cut(image("rgb", 10));
  cut(image("depth", 20));
  std::filesystem::remove(image("rgb", 15));
  const std::vector<std::string> words{"train", sequence_,      "--every", "5",     "--cloud",
                                       cloud,   "--iterations", "20",      "--out", scratch_ / "map.ply"};
  const RunResult run = run_odosplat(words);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("2 of 6 frames cannot be read, such as " + image("rgb", 10)));
  EXPECT_THAT(run.err, HasSubstr("1 of 30 listed images are not there, such as " + image("rgb", 15) + ": is missing"));
  EXPECT_THAT(run.err, HasSubstr(image("depth", 20)));
}

TEST_F(LostWork, AMissingImageIsALostFrame) {
  std::filesystem::remove(image("rgb", 15));
  const RunResult run = run_odosplat(track());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(status().size(), frames + 1U);
  EXPECT_THAT(run.err, HasSubstr("1 of 30 frames cannot be read"));
}

/// Rewrites the list of images with a pause of half a minute before frame 20.
void slow_down(const std::string& sequence, int frames) {
  std::string list;
  for (int k = 0; k < frames; ++k) {
    char line[64];
    std::snprintf(line, sizeof(line), "%.6f rgb/%04d.png\n", k < 20 ? k / 30.0 : 30.0 + k / 30.0, k);
    list += line;
  }
  write_text(sequence + "/rgb.txt", list);
  std::filesystem::remove(sequence + "/depth.txt");
}

TEST_F(LostWork, RealTimeHearsSignalsBetweenFramesAndKeepsWhatItHas) {
  const std::string cloud = scratch_ / "cloud.ply";
  ASSERT_EQ(run_odosplat({"cloud", sequence_, "--every", "5", "--voxel", "0.03", "--out", cloud}).status, 0);
  slow_down(sequence_, frames);
  std::vector<std::string> words{"track", sequence_, "--method", "interpolation", "--cloud", cloud, "--start",
                                 "",      "--out",   out_,       "--realtime"};
  const StampedPose first = read_trajectory(sequence_ + "/groundtruth.txt")[0];
  const Eigen::Vector3d t = first.T_world_camera.translation();
  const Eigen::Quaterniond q = first.T_world_camera.rotation();
  char start[200];
  std::snprintf(start, sizeof(start), "%.9f %.9f %.9f %.9f %.9f %.9f %.9f", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                q.w());
  words[7] = start;
  // The results so far are written every few seconds, so the first are there before the pause ends.
  const auto written = [&] { return std::filesystem::exists(out_ + "/report.json"); };
  using Clock = std::chrono::steady_clock;
  Clock::time_point signalled;
  const RunResult run = run_odosplat_and_signal(words, SIGINT, [&] {
    if (!written()) return false;
    signalled = Clock::now();
    return true;
  });
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - signalled).count(), 3.0);
  EXPECT_GE(status().size(), 2U);
  EXPECT_EQ(report()["finished"], false);
}

TEST_F(LostWork, LeftoversOfAKilledRunAreRemovedByTheNext) {
  std::filesystem::create_directories(out_);
  const std::string leftover = out_ + "/status.csv.odosplat-0123456789abcdef.part";
  write_text(leftover, "half");
  ASSERT_EQ(run_odosplat(track()).status, 0);
  EXPECT_FALSE(std::filesystem::exists(leftover));
}

}  // namespace
}  // namespace odosplat::apps_test
