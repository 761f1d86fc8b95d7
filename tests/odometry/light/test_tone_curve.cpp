// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/light/tone_curve.hpp"
#include "tests/odometry/room_pair.hpp"

namespace odosplat {
namespace {

void raise(GrayImage& image, double gamma) { cv::pow(image, gamma, image); }

class ToneCurveTest : public test::RoomPairTest {
 protected:
  std::shared_ptr<const FramePyramid> seen(double gamma, double gain = 1.0, double offset = 0.0) const {
    return RoomPairTest::seen([&](GrayImage& image) {
      raise(image, gamma);
      image = gain * image + offset;
    });
  }

  /// Root mean square difference between the curve, after the best gain and offset, and grey^gamma, over the
  /// reference's grey values.
  double error(const ToneCurve& curve, double gamma) const {
    std::vector<cv::Point2d> pairs;
    for (const ReferencePoint& point : reference_.levels[0]) {
      const auto i = static_cast<std::size_t>(std::lround(255.0F * point.intensity));
      pairs.emplace_back(curve[i], std::pow(static_cast<double>(i) / 255.0, gamma));
    }
    Eigen::MatrixX2d A(static_cast<Eigen::Index>(pairs.size()), 2);
    Eigen::VectorXd b(A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const cv::Point2d& pair = pairs[static_cast<std::size_t>(i)];
      A.row(i) << pair.x, 1.0;
      b[i] = pair.y;
    }
    const Eigen::Vector2d straight = A.colPivHouseholderQr().solve(b);
    return std::sqrt((A * straight - b).squaredNorm() / static_cast<double>(A.rows()));
  }
};

TEST_F(ToneCurveTest, IsFoundWhereTheImageHasAnotherGamma) {
  ToneCurve straight;
  for (std::size_t i = 0; i < straight.size(); ++i) straight[i] = static_cast<float>(i) / 255.0F;
  for (const double gamma : {0.5, 1.8}) {
    SCOPED_TRACE(gamma);
    const auto target = seen(gamma, 0.8, 0.05);
    const Alignment alignment = aligned(*target);
    const auto curve = estimate_tone(reference_, *target, alignment.T_target_host, alignment.brightness, {});
    ASSERT_TRUE(curve);
    EXPECT_LT(error(*curve, gamma), 0.25 * error(straight, gamma));
  }
}

TEST_F(ToneCurveTest, GainAndOffsetAreNone) {
  for (const double gain : {0.6, 1.0}) {
    const auto target = seen(1.0, gain, 0.1);
    const Alignment alignment = aligned(*target);
    EXPECT_FALSE(estimate_tone(reference_, *target, alignment.T_target_host, alignment.brightness, {})) << gain;
  }
}

TEST_F(ToneCurveTest, IsNotReadIntoAWrongPose) {
  const auto target = seen(1.0);
  for (const double angle : {0.02, 0.05, 0.1}) {
    const SE3 T_target_host = SE3(so3_exp({angle, 0.0, 0.0}), {0.0, 0.0, 0.1}) * T_target_host_;
    EXPECT_FALSE(estimate_tone(reference_, *target, T_target_host, {}, {})) << angle;
  }
}

TEST_F(ToneCurveTest, FoldedOnesAreRefused) {
  // Dark and bright pixels become equal: a curve explains this, but no camera has such a curve.
  const auto target = RoomPairTest::seen([](GrayImage& image) { image = cv::abs(image - cv::mean(image)[0]); });
  EXPECT_FALSE(estimate_tone(reference_, *target, T_target_host_, {}, {}));
}

TEST_F(ToneCurveTest, OfTooFewPointsIsNone) {
  TrackingReference few = reference_;
  few.levels[1].resize(100);
  const auto target = seen(0.5);
  EXPECT_TRUE(estimate_tone(reference_, *target, T_target_host_, aligned(*target).brightness, {}));
  EXPECT_FALSE(estimate_tone(few, *target, T_target_host_, aligned(*target).brightness, {}));
}

TEST(ToneCurve, IsStraightBetweenItsValues) {
  ToneCurve curve;
  for (std::size_t i = 0; i < curve.size(); ++i) curve[i] = static_cast<float>(i * i);
  const GrayImage image = (GrayImage(1, 4) << -1.0F, 1.5F / 255.0F, 1.0F, 2.0F);
  const GrayImage toned = apply_tone(image, curve);
  EXPECT_FLOAT_EQ(toned(0, 0), 0.0F);
  EXPECT_NEAR(toned(0, 1), 2.5F, 1e-4F);
  EXPECT_FLOAT_EQ(toned(0, 2), 65025.0F);
  EXPECT_FLOAT_EQ(toned(0, 3), 65025.0F);
}

TEST(ToneCurve, BadOptionsAreRefused) {
  ToneOptions options;
  options.min_slope = 0.0;
  EXPECT_THROW(options.check(), InputError);
}

TEST(ToneCurve, TakesTheBiasOffACameraWithAnotherGamma) {
  const auto brighter = [](int, GrayImage& image) { raise(image, 0.4); };
  OdometryOptions options;
  const double error = test::error_of_run(options, brighter);
  options.keyframe.anchor.tone.enabled = false;
  const double without = test::error_of_run(options, brighter);
  EXPECT_LT(error, 0.001);
  EXPECT_GT(without, 2.0 * error);
}

}  // namespace
}  // namespace odosplat
