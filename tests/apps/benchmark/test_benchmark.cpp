// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The benchmark command on a suite of one small room: its tables, resuming after a kill, wrong flags.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Benchmark : public testing::Test {
 protected:
  Benchmark() {
    write_tiny_sequence(folder / "room", 24);
    write_text(folder / "suite.yaml", R"(suite: tiny
scenes: [{name: box, words: A box}]
sequences: [{name: room, scene: box, path: room}]
methods: [{name: crash, command: [sh, -c, "kill -SEGV $$"]}]
)");
  }
  std::vector<std::string> command(const std::string& out) const {
    return {"benchmark",
            "--suite",
            (folder / "suite.yaml").string(),
            "--out",
            (folder / out).string(),
            "--jobs",
            "1",
            "--methods",
            "interpolation,rgbd,crash",
            "--runs",
            "2"};
  }

  ScratchFolder folder;
};

TEST_F(Benchmark, WritesEveryReportAndGoesOnAfterAKill) {
  const RunResult whole = run_odosplat(command("whole"));
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("room"));
  const std::string tables = read_text(folder / "whole/tables.csv");
  EXPECT_THAT(tables, HasSubstr("accuracy,room,crash,ate_m,,,,x,,killed by signal 11"));
  EXPECT_THAT(tables, HasSubstr("accuracy,room,rgbd,ate_m,0.0"));
  for (const char* file : {"report.md", "report.html", "report.json", "tables.tex", "speed.csv", "speed.tex"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "whole" / file)) << file;
  }

  // Killed after the record of the first run is written, before the others.
  const auto first = folder / "killed/jobs/track/room/interpolation/1/record.json";
  const RunResult killed = run_odosplat_and_signal(command("killed"), SIGKILL, [&] { return exists(first); });
  EXPECT_EQ(killed.status, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder / "killed/report.md"));
  const auto made = std::filesystem::last_write_time(first);
  ASSERT_EQ(run_odosplat(command("killed")).status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(first), made);
  EXPECT_EQ(read_text(folder / "killed/tables.csv"), tables);
  EXPECT_EQ(read_text(folder / "killed/tables.tex"), read_text(folder / "whole/tables.tex"));
}

TEST_F(Benchmark, JobByJobGivesTheSameTables) {
  ASSERT_EQ(run_odosplat(command("whole")).status, 0);
  std::vector<std::string> plan = command("jobs");
  plan.push_back("--plan");
  ASSERT_EQ(run_odosplat(plan).status, 0);
  const std::string out = (folder / "jobs").string();
  std::vector<std::string> ids{"check/room", "cloud/box"};
  for (const char* method : {"interpolation", "rgbd", "crash"}) {
    for (const char* run : {"/1", "/2"}) ids.push_back(std::string("track/room/") + method + run);
  }
  for (const std::string& id : ids) {
    EXPECT_EQ(run_odosplat({"benchmark", "--out", out, "--job", id}).status, 0) << id;
  }
  ASSERT_EQ(run_odosplat({"benchmark", "--out", out, "--report"}).status, 0);
  EXPECT_EQ(read_text(folder / "jobs/tables.csv"), read_text(folder / "whole/tables.csv"));
}

TEST_F(Benchmark, FaultsAreOneLine) {
  const auto fault = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = command("none");
    all.insert(all.end(), more.begin(), more.end());
    const RunResult result = run_odosplat(all);
    EXPECT_EQ(result.status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
    return result.err;
  };
  EXPECT_THAT(fault({"--sequences", "hall"}), HasSubstr("--sequences: suite tiny has no hall"));
  EXPECT_THAT(fault({"--mapping", "none"}), HasSubstr("--mapping"));
  EXPECT_THAT(fault({"--root", "/no/such/folder"}), HasSubstr("--root"));
  EXPECT_EQ(run_odosplat({"benchmark", "--suite", "icl", "--out", (folder / "none").string()}).status, 2);
  EXPECT_THAT(run_odosplat({"benchmark", "--out", (folder / "none").string()}).err,
              HasSubstr("no benchmark was begun"));
}

}  // namespace
}  // namespace odosplat::apps_test
