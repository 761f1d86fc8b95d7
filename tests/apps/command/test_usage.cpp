// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/apps/run_program.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;

TEST(Program, HelpAndVersionSucceed) {
  EXPECT_EQ(run_odosplat({"--help"}).status, 0);
  EXPECT_THAT(run_odosplat({"--version"}).out, HasSubstr("0.1.0"));
  for (const char* command : {"devices", "check", "cloud", "align", "convert", "train", "render", "track", "relocalise",
                              "eval", "eval-depth", "view", "demo", "map"}) {
    const RunResult result = run_odosplat({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.out, HasSubstr("--help")) << command;
  }
}

TEST(Program, BadUsageIsOneLineAndExit2) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"fly"},
                                                {"devices", "--nonsense"},
                                                {"devices", "--threads", "-3"},
                                                {"devices", "--log", "loud"},
                                                {"eval", "a.txt"}}) {
    const RunResult result = run_odosplat(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(Program, DevicesListsTheChosenOne) {
  const RunResult result = run_odosplat({"devices", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto list = nlohmann::json::parse(result.out);
  ASSERT_FALSE(list.empty());
  int chosen = 0;
  for (const auto& device : list) chosen += device["chosen"].get<bool>() ? 1 : 0;
  EXPECT_EQ(chosen, 1);
  EXPECT_THAT(run_odosplat({"devices"}).out, HasSubstr(list[0]["name"].get<std::string>()));
}

TEST(Program, UnknownDeviceIsBadInput) {
  const RunResult result = run_odosplat({"devices", "--device", "no such device"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no such OpenCL device"));
}

}  // namespace
}  // namespace odosplat::apps_test
