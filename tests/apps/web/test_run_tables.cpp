// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/run_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/cli/view/web/page_paths.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string heading = "time,status,keyframe,inlier_share,milliseconds,map_share,in_map,confirmed,reason\n";

template <typename Read>
std::string fault_of(Read read) {
  try {
    read();
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(StatusTable, IsRead) {
  const auto rows = parse_status_table("status.csv", heading +
                                                         "1.5,ok,1,0.9,3.1,1.0,1,0.98,\n"
                                                         "1.6,relocalised,0,0.9,3.1,1.0,0,,\n"
                                                         "1.7,lost,0,0,3.1,0,0,,\"no \"\"image\"\", or\"\n");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].status, "ok");
  EXPECT_TRUE(rows[0].keyframe && rows[0].in_map);
  EXPECT_DOUBLE_EQ(rows[0].confirmed, 0.98);
  EXPECT_FALSE(rows[1].in_map);
  EXPECT_TRUE(std::isnan(rows[1].confirmed));
  EXPECT_DOUBLE_EQ(rows[2].time, 1.7);
  EXPECT_EQ(rows[2].reason, "no \"image\", or");
  EXPECT_EQ(parse_status_table("s", "status,in_map,time\nlost,0,4\n")[0].time, 4.0) << "columns go by their names";
}

TEST(StatusTable, NamesWhatIsWrong) {
  const auto fault = [](const std::string& text) { return fault_of([&] { parse_status_table("s.csv", text); }); };
  EXPECT_THAT(fault(""), HasSubstr("s.csv: is empty"));
  EXPECT_THAT(fault("time,status\n"), HasSubstr("no column \"in_map\""));
  EXPECT_THAT(fault(heading + "1,ok\n"), HasSubstr("s.csv: line 2: has 2 values, the heading 9"));
  EXPECT_THAT(fault(heading + "x,ok,1,1,1,1,1,1,\n"), HasSubstr("the time is no number"));
  EXPECT_THAT(fault(heading + "2,ok,1,1,1,1,1,1,\n1,ok,1,1,1,1,1,1,\n"), HasSubstr("line 3: the time 1 is before"));
  EXPECT_THAT(fault(heading + "2,good,1,1,1,1,1,1,\n"), HasSubstr("status must be ok, relocalised or lost"));
}

std::string covariance_row(const std::string& time, const std::vector<double>& diagonal) {
  std::string row = time;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j) row += "," + std::to_string(i == j ? diagonal[i] : 0.0);
  }
  return row + "\n";
}

TEST(CovarianceTable, GivesTheSigmaOfTheCamerasPosition) {
  const Trajectory poses{{1.0, SE3(), ""}, {2.0, SE3(Eigen::Quaterniond::Identity(), {3.0, 0.0, 0.0}), ""}};
  const std::string text = "# upper triangle\ntime,tx_tx\n" + covariance_row("1.0", {0.01, 0.04, 0.04, 0.0, 0.0, 0.0}) +
                           covariance_row("1.5", {1, 1, 1, 1, 1, 1}) + covariance_row("2.0", {0, 0, 0, 0.0, 0.01, 0.0});
  const auto sigmas = parse_covariance_table("c.csv", text, poses);
  ASSERT_EQ(sigmas.size(), 2U) << "1.5 has no pose";
  EXPECT_NEAR(sigmas[0].position_m, 0.3, 1e-9);
  EXPECT_NEAR(sigmas[0].rotation_deg, 0.0, 1e-9);
  EXPECT_NEAR(sigmas[1].position_m, 0.3, 1e-9) << "0.1 rad around the world's origin, 3 m away";
  EXPECT_NEAR(sigmas[1].rotation_deg, 5.7296, 1e-3);
}

TEST(CovarianceTable, NamesWhatIsWrong) {
  const auto fault = [](const std::string& text) {
    return fault_of([&] { parse_covariance_table("c.csv", text, {}); });
  };
  EXPECT_THAT(fault("1,2,3\n"), HasSubstr("c.csv: line 1: has 3 values, must have 22"));
  const std::string row = covariance_row("2", {1, 1, 1, 1, 1, 1});
  EXPECT_THAT(fault(row + covariance_row("1", {1, 1, 1, 1, 1, 1})), HasSubstr("line 2: the time 1 is before"));
  EXPECT_THAT(fault(row.substr(0, row.rfind(',')) + ",nan\n"), HasSubstr("is no number"));
}

StampedPose pose_at(double time, double x = 0.0) {
  return {time, SE3(Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}), ""};
}

TEST(PageTimes, AreThoseOfAllRowsAndPoses) {
  PageRun a;
  a.estimate = {pose_at(1.0), pose_at(3.0)};
  StatusRow lost;
  lost.time = 2.0;
  a.status = {lost};
  PageRun b;
  b.estimate = {pose_at(1.0001), pose_at(2.5)};
  const std::vector<double> times = page_times({a, b}, {pose_at(0.0)}, {9.0});
  EXPECT_THAT(times, ElementsAre(1.0, 2.0, 2.5, 3.0));
  EXPECT_EQ(page_frame(times, 1.0001), 0U);
  EXPECT_EQ(page_frame(times, 2.0), 1U);
  EXPECT_EQ(page_frame(times, 2.2), std::nullopt);
  EXPECT_EQ(page_frame(times, 4.0), std::nullopt);
  EXPECT_THAT(page_times({}, {pose_at(5.0)}, {9.0}), ElementsAre(5.0));
  EXPECT_THAT(page_times({}, {}, {9.0}), ElementsAre(9.0));
}

std::vector<float> numbers_at(const PageNumbers& numbers, const nlohmann::ordered_json& where) {
  std::vector<float> values;
  for (std::size_t k = 0; k < where.at("count").get<std::size_t>(); ++k) {
    values.push_back(load_little<float>(numbers.bytes().data() + 4 * (where.at("at").get<std::size_t>() + k)));
  }
  return values;
}

TEST(PageRun, KnowsWhereFramesAreLost) {
  PageRun run;
  run.name = "run";
  run.estimate = {pose_at(0.0, 1.0), pose_at(0.2, 2.0), pose_at(0.3, 3.0)};
  for (const double time : {0.0, 0.1, 0.2, 0.3}) {
    StatusRow row;
    row.time = time;
    row.status = time == 0.1 ? "lost" : "ok";
    row.reason = time == 0.1 ? "dark" : "";
    run.status.push_back(row);
  }
  PageNumbers numbers;
  const nlohmann::ordered_json json = json_of_run(run, page_times({run}, {}, {}), numbers);
  EXPECT_THAT(numbers_at(numbers, json.at("status")), ElementsAre(1.0F, 3.0F, 1.0F, 1.0F));
  EXPECT_THAT(numbers_at(numbers, json.at("gap")), ElementsAre(0.0F, 0.0F, 1.0F, 0.0F));
  EXPECT_EQ(json.at("reasons").at("1"), "dark");
  const std::vector<float> poses = numbers_at(numbers, json.at("poses"));
  ASSERT_EQ(poses.size(), 28U);
  EXPECT_EQ(poses[0], 1.0F);
  EXPECT_TRUE(std::isnan(poses[7]));
  EXPECT_EQ(poses[14], 2.0F);
  EXPECT_EQ(poses[6], 1.0F) << "qw";
}

TEST(PageRun, WithoutATableALongStepIsAGap) {
  PageRun run;
  for (const double time : {0.0, 0.1, 0.2, 0.8, 0.9}) run.estimate.push_back(pose_at(time));
  PageNumbers numbers;
  const nlohmann::ordered_json json = json_of_run(run, page_times({run}, {}, {}), numbers);
  EXPECT_THAT(numbers_at(numbers, json.at("gap")), ElementsAre(0.0F, 0.0F, 0.0F, 1.0F, 0.0F));
  EXPECT_FALSE(json.contains("status"));
  EXPECT_FALSE(json.contains("position_error_m"));
}

}  // namespace
}  // namespace odosplat::apps
