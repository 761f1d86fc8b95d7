// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

class ProgressTest : public testing::Test {
 protected:
  // Standard error is captured to a file: the output without a terminal is tested, wherever the tests run.
  void SetUp() override { testing::internal::CaptureStderr(); }
};

TEST_F(ProgressTest, SaysWhatIsDoneAndTheCallersText) {
  Progress progress("train", 3);
  progress.update(3, "loss 0.5");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "train 3/3  left 0:00  loss 0.5\n");
}

TEST_F(ProgressTest, FirstLineGuessesNoTime) {
  Progress progress("train", 4000);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  progress.update(1);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("train 1/4000  left -:--"));
}

TEST_F(ProgressTest, WithoutATotalSaysWhatIsDone) {
  Progress progress("track", Progress::unknown);
  for (long k = 1; k < 500; ++k) progress.update(k, "ok");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "track 1  ok\n");
}

TEST_F(ProgressTest, IsSilentWhereTheLogShowsNoInformation) {
  set_log_level("warning");
  Progress progress("train", 3);
  progress.update(1);
  progress.update(3, "loss 0.5");
  progress.finish();
  set_log_level("info");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ProgressTest, ShowsNoControlCharacters) {
  Progress progress("cloud a\x1b[2Jb", 1);
  progress.update(1, "\a");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "cloud a\\x1b[2Jb 1/1  left 0:00  \\x07\n");
}

TEST(TimeLeft, FollowsFromTheStepsAfterTheFirstReport) {
  TimeLeft left(4000);
  // 70 s before the first step is done, such as for building kernels; then 10 steps per second.
  EXPECT_EQ(left.update(1, 70.0), std::nullopt);
  EXPECT_EQ(left.update(11, 71.0), std::nullopt) << "after 1 s";
  EXPECT_EQ(left.update(31, 73.0), std::nullopt) << "after 0.8 % of the steps";
  EXPECT_NEAR(left.update(101, 80.0).value(), 389.9, 1e-9);
  EXPECT_EQ(left.update(4000, 500.0), 0.0);
}

TEST(TimeLeft, CountsNoStepsOfAnEarlierRun) {
  TimeLeft left(10000);
  EXPECT_EQ(left.update(9601, 0.0), std::nullopt);
  EXPECT_NEAR(left.update(9611, 5.0).value(), 194.5, 1e-9);
}

TEST(TimeLeft, OfSlowStepsIsKnownAfterTwentySeconds) {
  TimeLeft left(100000);
  EXPECT_EQ(left.update(1, 0.0), std::nullopt);
  EXPECT_EQ(left.update(2, 19.0), std::nullopt);
  EXPECT_NEAR(left.update(3, 40.0).value(), 20.0 * 99997.0, 1e-6);
  EXPECT_EQ(TimeLeft(0).update(0, 0.0), 0.0);
}

/// The output of Progress to a terminal with this number of columns.
std::string drawn_on_terminal(unsigned short columns, const std::string& detail) {
  int master = -1;
  int terminal = -1;
  winsize size{24, columns, 0, 0};
  if (openpty(&master, &terminal, nullptr, nullptr, &size) != 0) return "no terminal";
  const int kept = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  {
    Progress progress("train", 4000);
    progress.update(4000, detail);
  }
  dup2(kept, STDERR_FILENO);
  close(kept);
  close(terminal);
  char bytes[4096];
  std::string text;
  for (ssize_t n = 0; (n = read(master, bytes, sizeof(bytes))) > 0;) text.append(bytes, static_cast<std::size_t>(n));
  close(master);
  return text;
}

/// Columns of the longest line drawn, without control sequences.
int widest_line(std::string text) {
  const std::string redraw = "\r\x1b[K";
  for (std::size_t at = 0; (at = text.find(redraw)) != std::string::npos;) text.replace(at, redraw.size(), "\n");
  int widest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    widest = std::max(widest, text_columns(text.substr(0, end)));
    text.erase(0, end + 1);
  }
  return widest;
}

TEST(ProgressOnTerminal, FitsItsWidth) {
  const std::string detail = "loss 0.0412  PSNR 27.31 dB  150000 Gaussians  12.3 it/s  and more words";
  for (const std::uint16_t columns : std::vector<std::uint16_t>{20, 40, 80, 81, 200}) {
    const std::string drawn = drawn_on_terminal(columns, detail);
    EXPECT_LT(widest_line(drawn), columns) << drawn;
    EXPECT_THAT(drawn, HasSubstr("train [##"));
  }
  EXPECT_THAT(drawn_on_terminal(200, detail), HasSubstr("left 0:00  " + detail));
  EXPECT_THAT(drawn_on_terminal(80, "loss 0.0412"), HasSubstr("loss 0.0412"));
}

}  // namespace
}  // namespace odosplat
