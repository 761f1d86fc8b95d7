// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/even_rows.hpp"
#include "tests/odometry/room_pair.hpp"

namespace odosplat {
namespace {

/// Gain as a function of the position over the rows, 0..1.
using Curve = std::function<double(double)>;

class RowGainTest : public test::RoomPairTest {
 protected:
  static double at_row(int row, int rows) { return (row + 0.5) / rows; }

  std::shared_ptr<const FramePyramid> seen(const Curve& gain) const {
    return RoomPairTest::seen([&](GrayImage& image) {
      for (int y = 0; y < image.rows; ++y) image.row(y) *= gain(at_row(y, image.rows));
    });
  }

  /// Root mean square difference from the curve, both scaled to a mean of 1.
  static double error(const RowGain& gain, const Curve& truth) {
    const int rows = static_cast<int>(gain.size());
    double mean = 0.0;
    for (int y = 0; y < rows; ++y) mean += truth(at_row(y, rows)) / rows;
    double squares = 0.0;
    for (int y = 0; y < rows; ++y) {
      squares += std::pow(gain[static_cast<std::size_t>(y)] - truth(at_row(y, rows)) / mean, 2) / rows;
    }
    return std::sqrt(squares);
  }

  const Curve even_ = [](double) { return 1.0; };
  const Curve ramp_ = [](double at) { return 1.2 - 0.4 * at; };
  const Curve waves_ = [](double at) { return 1.0 + 0.15 * std::sin(2.0 * std::numbers::pi * (1.6 * at + 0.3)); };
  const Curve dark_band_ = [](double at) { return 1.0 - 0.3 * std::exp(-50.0 * (at - 0.6) * (at - 0.6)); };
};

TEST_F(RowGainTest, IsFoundInWhateverShape) {
  for (const Curve& curve : {ramp_, waves_, dark_band_}) {
    EvenFrame frame = make_even(seen(curve));
    Alignment alignment = aligned(*frame.even);
    EXPECT_TRUE(even_rows(aligner_, reference_, frame, alignment));
    EXPECT_GT(unevenness(frame.row_gain), 0.05);
    EXPECT_LT(error(frame.row_gain, curve), 0.015);  // about a tenth of the gain's variation
  }
}

TEST_F(RowGainTest, TakenOffGivesThePoseOfAnEvenImage) {
  for (const Curve& curve : {ramp_, waves_, dark_band_}) {
    EvenFrame frame = make_even(seen(curve));
    Alignment alignment = aligned(*frame.even);
    const double uneven = error_m(alignment);
    even_rows(aligner_, reference_, frame, alignment);
    EXPECT_LT(error_m(alignment), 0.0015);
    EXPECT_GT(uneven, 2.0 * error_m(alignment));
  }
}

TEST_F(RowGainTest, OfAnEvenImageIsNone) {
  const EvenFrame given = make_even(seen(even_));
  const Alignment before = aligned(*given.even);
  EvenFrame frame = given;
  Alignment alignment = before;
  EXPECT_FALSE(even_rows(aligner_, reference_, frame, alignment));
  EXPECT_EQ(frame.even, given.even);
  EXPECT_TRUE(frame.row_gain.empty());
  EXPECT_EQ(alignment.T_target_host.translation(), before.T_target_host.translation());
}

TEST_F(RowGainTest, IsGivenUpWhereTheLightIsEvenAgain) {
  RowGain stale;
  for (int y = 0; y < camera_.height; ++y) stale.push_back(static_cast<float>(waves_(at_row(y, camera_.height))));
  EvenFrame frame = make_even(seen(even_), stale);
  Alignment alignment = aligned(*frame.even);
  EXPECT_TRUE(even_rows(aligner_, reference_, frame, alignment));
  EXPECT_TRUE(frame.row_gain.empty());
  EXPECT_EQ(cv::norm(frame.even->gray[0], frame.taken->gray[0], cv::NORM_INF), 0.0);
}

TEST_F(RowGainTest, IsNotLookedForIfSwitchedOff) {
  ImageAlignerOptions options;
  options.row_gain.enabled = false;
  EvenFrame frame = make_even(seen(waves_));
  Alignment alignment = aligned(*frame.even);
  EXPECT_FALSE(even_rows(ImageAligner(options), reference_, frame, alignment));
  options.row_gain.spans = 0;
  EXPECT_THROW(ImageAligner{options}, InputError);
}

TEST_F(RowGainTest, DividesEveryLevelOfThePyramid) {
  RowGain gain;
  for (int y = 0; y < camera_.height; ++y) gain.push_back(static_cast<float>(waves_(at_row(y, camera_.height))));
  const FramePyramid given = *seen(waves_);
  const FramePyramid flat = divide_rows(given, gain);
  const FramePyramid truth = *seen(even_);
  ASSERT_EQ(flat.levels(), truth.levels());
  for (std::size_t level = 0; level < flat.gray.size(); ++level) {
    EXPECT_LT(cv::norm(flat.gray[level], truth.gray[level], cv::NORM_INF), 0.002) << level;
    EXPECT_GT(cv::norm(given.gray[level], truth.gray[level], cv::NORM_INF), 0.05) << level;
  }
}

TEST_F(RowGainTest, IsNotReadIntoAWrongPose) {
  // With a rotation error of more than a degree the images differ similarly to uneven light, but no row gain explains
  // that.
  const auto target = seen(even_);
  RowGainOptions options;
  options.least = 0.005;
  RowGainOptions credulous = options;
  credulous.explained = 1.0;
  for (const double angle : {0.02, 0.05, 0.1}) {
    const SE3 T_target_host = SE3(so3_exp({angle, 0.0, 0.0}), {0.0, 0.0, 0.1}) * T_target_host_;
    EXPECT_TRUE(estimate_row_gain(reference_, *target, T_target_host, {}, options).empty()) << angle;
    EXPECT_FALSE(estimate_row_gain(reference_, *target, T_target_host, {}, credulous).empty()) << angle;
  }
}

TEST_F(RowGainTest, OfTooFewPointsIsEmpty) {
  TrackingReference few = reference_;
  few.levels[1].resize(50);
  EXPECT_TRUE(estimate_row_gain(few, *seen(waves_), T_target_host_, {}, {}).empty());
}

TEST(RowGain, KeepsThePathThroughLightThatRollsOverTheRows) {
  const auto roll = [](int k, GrayImage& image) {
    for (int y = 0; y < image.rows; ++y) {
      const double turn = 1.3 * y / image.rows + k / 40.0;
      image.row(y) *= 1.0 + 0.15 * std::sin(2.0 * std::numbers::pi * turn);
    }
  };
  OdometryOptions options;
  const double error = test::error_of_run(options, roll);
  EXPECT_LT(error, 0.0015);
  options.aligner.row_gain.enabled = false;
  EXPECT_GT(test::error_of_run(options, roll), 3.0 * error);
}

TEST(RowGain, UnevennessIsARootMeanSquare) {
  EXPECT_NEAR(unevenness({1.1F, 0.9F}), 0.1, 1e-6);
  EXPECT_EQ(unevenness({}), 0.0);
}

}  // namespace
}  // namespace odosplat
