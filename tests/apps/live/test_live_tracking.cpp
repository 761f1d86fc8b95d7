// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// `odosplat track` with live sources: poses, report, parts, interruption, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/live/live_world.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Json report_in(const std::string& folder) { return Json::parse(read_text(folder + "/report.json")); }

SE3 pose_of(const Json& line) {
  const std::vector<double> v = line["pose"];
  return {Eigen::Quaterniond(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]}};
}

constexpr int frames = 60;

TEST(LiveTracking, OfAPipeGivesThePosesOfTheFile) {
  LiveWorld world(frames);
  const std::string recorded = world.file("recorded");
  std::vector<std::string> words = world.track(world.sequence());
  words[11] = recorded;
  ASSERT_EQ(run_odosplat(words).status, 0);
  const Trajectory file = read_trajectory(recorded + "/trajectory_live.txt");
  ASSERT_EQ(file.size(), 1U * frames);

  UdpReader reader;
  world.play(frames, 60);
  const RunResult run = run_odosplat(world.track(world.fifo(), {"--stream", reader.address()}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("from arrival to pose: "));
  const Json report = report_in(world.out());
  const std::size_t tracked = report["frames"];
  const std::size_t dropped = report["dropped"];
  EXPECT_EQ(report["source"], world.fifo());
  EXPECT_EQ(report["live"], true);
  EXPECT_EQ(report["finished"], true);
  EXPECT_EQ(report["parts"], 0);
  EXPECT_EQ(tracked + dropped, 1U * frames);  // none of a pipe's images is lost unseen
  EXPECT_GT(tracked, 20U);
  EXPECT_GT(report["latency_ms"]["median"], 0.0);
  EXPECT_GE(report["latency_ms"]["p95"], report["latency_ms"]["median"]);
  EXPECT_GE(report["latency_ms"]["p99"], report["latency_ms"]["p95"]);
  EXPECT_GE(report["latency_ms"]["max"], report["latency_ms"]["p99"]);

  const std::vector<std::string> lines = reader.finish();
  ASSERT_EQ(lines.size(), tracked);
  EXPECT_EQ(report["stream"]["sent"], tracked);
  EXPECT_EQ(report["stream"]["dropped"], 0);
  const std::vector<std::string> status = lines_of(read_text(world.out() + "/status.csv"));
  ASSERT_EQ(status.size(), tracked + 1);
  EXPECT_THAT(status[0], testing::EndsWith(",reason,latency_ms"));
  std::size_t last = 0;
  double last_time = 0.0;
  std::size_t posed = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Json line = Json::parse(lines[k]);
    const std::size_t number = line["frame"];
    const double time = line["time"];
    ASSERT_LT(number, 1U * frames);
    if (k > 0) {
      EXPECT_GT(number, last);
      const double step = static_cast<double>(number - last) / 30.0;
      EXPECT_NEAR(time - last_time, step, 0.006 * step + 1e-5);
    }
    last = number;
    last_time = time;
    EXPECT_THAT(status[k + 1], testing::StartsWith(StampedPose{time, {}, ""}.stamp() + ","));
    EXPECT_GT(line["latency_ms"], 0.0);
    if (line["pose"].is_null()) continue;
    ++posed;
    const SE3 difference = file[number].T_world_camera.inverse() * pose_of(line);
    EXPECT_LT(difference.translation().norm(), 0.03) << number;
    EXPECT_EQ(line["covariance"].size(), 21U);
  }
  EXPECT_EQ(last, frames - 1U);
  EXPECT_EQ(report["posed"], posed);
  EXPECT_GT(posed, tracked * 3 / 4);
  EXPECT_EQ(read_trajectory(world.out() + "/trajectory.txt").size(), posed);
}

TEST(LiveTracking, PutsResultsAsideInParts) {
  LiveWorld world(frames);
  world.play(100, 60);
  const RunResult run = run_odosplat(world.track(world.fifo(), {"--part-frames", "10"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const Json report = report_in(world.out());
  const std::size_t parts = report["parts"];
  EXPECT_GE(parts, 2U);
  std::size_t rows = lines_of(read_text(world.out() + "/status.csv")).size() - 1;
  EXPECT_LT(rows, 25U);
  std::size_t poses = read_trajectory(world.out() + "/trajectory.txt").size();
  double last = 0.0;
  for (std::size_t k = 1; k <= parts; ++k) {
    const std::string part = world.out() + "/part-00000" + std::to_string(k);
    const std::vector<std::string> lines = lines_of(read_text(part + "/status.csv"));
    EXPECT_EQ(lines.size(), 11U);
    const Trajectory trajectory = read_trajectory(part + "/trajectory.txt");
    EXPECT_EQ(trajectory.size(), read_trajectory(part + "/trajectory_live.txt").size());
    ASSERT_FALSE(trajectory.empty());
    EXPECT_GT(trajectory.front().time, last);
    last = trajectory.back().time;
    rows += lines.size() - 1;
    poses += trajectory.size();
  }
  EXPECT_EQ(report["frames"], rows);
  EXPECT_EQ(report["posed"], poses);
  const RunResult again = run_odosplat(world.track(world.fifo()));
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("part-000001: is there from an earlier run"));
}

TEST(LiveTracking, InterruptedInABlockedReadKeepsItsResults) {
  LiveWorld world(frames);
  UdpReader reader;
  world.play(20, 40, true);  // then silence
  Clock::time_point signalled;
  Clock::time_point last_line = Clock::now();
  std::size_t lines = 0;
  const RunResult run = run_odosplat_and_signal(world.track(world.fifo(), {"--stream", reader.address()}), SIGINT, [&] {
    signalled = Clock::now();
    if (reader.lines() > lines) last_line = Clock::now();
    lines = reader.lines();
    return lines > 3 && signalled - last_line > std::chrono::milliseconds(1000);
  });
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(run.err, HasSubstr("interrupted"));
  // The requirement is one second; the rest allows for other load of the machine.
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - signalled).count(), 3.0);
  const Json report = report_in(world.out());
  EXPECT_EQ(report["finished"], false);
  EXPECT_EQ(report["frames"], lines);
  EXPECT_EQ(lines_of(read_text(world.out() + "/status.csv")).size(), lines + 1);
}

TEST(LiveTracking, RefusesWhatItCannotUse) {
  LiveWorld world(24);
  const std::string address = "rtsp://me:secret@127.0.0.1:1/x";
  const auto error_of = [&](const std::vector<std::string>& words) {
    const RunResult run = run_odosplat(words);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines_of(run.err).size(), 1U) << run.err;
    EXPECT_EQ(run.err.find("secret"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(world.out()));
    return run.err;
  };
  EXPECT_THAT(error_of({"track", address, "--map", "m.ply", "--out", world.out()}),
              HasSubstr("rtsp://me:***@127.0.0.1:1/x: a live source needs a camera file (--camera)"));
  EXPECT_THAT(error_of(world.track(address)), HasSubstr("rtsp://me:***@127.0.0.1:1/x: cannot be opened: "));
  EXPECT_THAT(error_of(world.track(address, {"--frames", "1:2"})), HasSubstr("--frames: cannot be used with a live"));
  EXPECT_THAT(error_of(world.track(address, {"--layout", "tum"})), HasSubstr("--layout: cannot be used with a live"));
  EXPECT_THAT(error_of({"track", address, "--start", "truth", "--camera", world.camera(), "--out", world.out()}),
              HasSubstr("--start: truth cannot be used with a live"));
  EXPECT_THAT(error_of({"track", address, "--method", "rgbd", "--camera", world.camera(), "--out", world.out()}),
              HasSubstr("--method: rgbd cannot be used with a live"));
  EXPECT_THAT(error_of({"track", world.sequence(), address, "--out", world.out()}),
              HasSubstr("takes no more arguments, there is rtsp://me:***@"));
  EXPECT_THAT(error_of(world.track(world.sequence(), {"--reconnect", "5"})), HasSubstr("--reconnect: is for live"));
  EXPECT_THAT(error_of(world.track(world.sequence(), {"--open-timeout", "5"})), HasSubstr("--open-timeout: is for"));
  EXPECT_THAT(error_of(world.track(world.sequence(), {"--part-frames", "5"})), HasSubstr("--part-frames: is for"));
  EXPECT_THAT(error_of(world.track(world.fifo(), {"--open-timeout", "0.3"})), HasSubstr("no image came within 0.3 s"));
  write_text(world.camera(), "width: 320\nheight: 240\nfx: 260\nfy: 260\ncx: 159.5\ncy: 119.5\n");
  world.play(10, 20);
  EXPECT_THAT(error_of(world.track(world.fifo())),
              HasSubstr("its images are 160x120; " + world.camera() + " is for 320x240: calibrate at the size of"));
}

}  // namespace
}  // namespace odosplat::apps_test
