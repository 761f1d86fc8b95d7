// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/fit_input.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "odosplat/core/error.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps {
namespace {

TEST(FitInput, ReadsEveryImageOnce) {
  const apps_test::ScratchFolder scratch;
  apps_test::write_tiny_sequence(scratch / "seq", 30);
  const Sequence sequence = Sequence::open((scratch / "seq").string());
  const CameraFitInput input = camera_fit_input(sequence);
  const cv::Mat1f gray = input.gray(0);
  const cv::Mat1f depth = input.depth(1, {});
  EXPECT_EQ(cv::norm(gray, sequence.gray(0), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(depth, sequence.depth(1), cv::NORM_INF), 0.0);
  std::filesystem::remove_all(scratch / "seq/rgb");
  std::filesystem::remove_all(scratch / "seq/depth");
  EXPECT_EQ(cv::norm(gray, input.gray(0), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(depth, input.depth(1, {}), cv::NORM_INF), 0.0);
  EXPECT_THROW(input.gray(1), InputError);
  EXPECT_THROW(input.depth(0, {}), InputError);
}

}  // namespace
}  // namespace odosplat::apps
