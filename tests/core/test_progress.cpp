// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "odosplat/core/progress.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

class ProgressTest : public testing::Test {
 protected:
  // Into a file: what is tested is the output that is no terminal's, wherever the tests run.
  void SetUp() override { testing::internal::CaptureStderr(); }
};

TEST_F(ProgressTest, SaysWhatIsDoneAndTheCallersText) {
  Progress progress("train", 3);
  progress.update(3, "loss 0.5");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "train 3/3  left 0:00  loss 0.5\n");
}

TEST_F(ProgressTest, TimeLeftFollowsFromThisRunsStepsAlone) {
  Progress progress("train", 10000, 9600);
  progress.update(9600);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("left -:--"));
  testing::internal::CaptureStderr();
  Progress later("train", 10000, 9600);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  later.update(9601);
  // 399 steps more of at least 0.3 s each: minutes, where 9601 steps in that time would leave none.
  const std::string line = testing::internal::GetCapturedStderr();
  EXPECT_THAT(line, testing::Not(HasSubstr("left 0:"))) << line;
}

}  // namespace
}  // namespace odosplat
