// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/combine_lens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "odosplat/camera/undistort.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const Camera wide{640, 480, 450.0, 452.0, 322.0, 236.0};
const Camera narrow{640, 480, 1000.0, 996.0, 322.0, 236.0};
const std::vector<double> barrel{-0.3, 0.1, 0.001, 0.0};

/// Largest distance [px] between where `combined` shows the rays of the undistorted image's pixels and where the
/// declared lens shows them behind the correction.
double largest_error(const Lens& declared, const CameraCorrection& correction, const Lens& combined) {
  const Undistorter before(declared.camera, declared.distortion);
  const Undistorter after(combined.camera, combined.distortion);
  double largest = 0.0;
  for (int v = 0; v < declared.camera.height; v += 20) {
    for (int u = 0; u < declared.camera.width; u += 20) {
      const Eigen::Vector3d ray = correction.ray(declared.camera, u, v);
      const Eigen::Vector2d undistorted = correction.project(declared.camera, ray);
      const Eigen::Vector2d expected = before.distort(undistorted.x(), undistorted.y());
      const Eigen::Vector2d pinhole = combined.camera.project(ray);
      largest = std::max(largest, (after.distort(pinhole.x(), pinhole.y()) - expected).norm());
    }
  }
  return largest;
}

TEST(CombineLens, WithoutDistortionItIsExact) {
  const CameraCorrection correction{0.02, 0.01, -0.03, 0.0, 0.02};
  for (const std::vector<double>& none : {std::vector<double>{}, std::vector<double>(5, 0.0)}) {
    const Lens declared{wide, none};
    const Lens lens = combined_lens(declared, wide, correction);
    EXPECT_NEAR(lens.camera.fx, 459.0, 1e-9);
    EXPECT_NEAR(lens.camera.fy, 461.04, 1e-9);
    EXPECT_NEAR(lens.camera.cx, 326.5, 1e-9);
    EXPECT_NEAR(lens.camera.cy, 222.44, 1e-9);
    EXPECT_TRUE(lens.distortion.empty());
    EXPECT_LT(largest_error(declared, correction, lens), 1e-9);
  }
  const CameraCorrection radial{0.02, 0.01, -0.03, -0.05, 0.0};
  const Lens declared{wide, {}};
  const Lens lens = combined_lens(declared, wide, radial);
  EXPECT_THAT(lens.distortion, testing::ElementsAre(-0.05, 0.0, 0.0, 0.0));
  EXPECT_LT(largest_error(declared, radial, lens), 1e-9);
}

// With rays stretched by s, k1 r^2 becomes k1 s^2 r^2, and p1 r^2 becomes p1 s r^2 behind the focal length.
TEST(CombineLens, AFocalLengthScalesTheCoefficients) {
  const CameraCorrection correction{0.03, 0.0, 0.0, 0.0, 0.0};
  const Lens declared{wide, barrel};
  const Lens lens = combined_lens(declared, wide, correction);
  EXPECT_NEAR(lens.camera.fx, 450.0 * 1.03, 1e-6);
  EXPECT_NEAR(lens.camera.fy, 452.0 * 1.03, 1e-6);
  EXPECT_NEAR(lens.camera.cx, 322.0, 1e-6);
  EXPECT_NEAR(lens.camera.cy, 236.0, 1e-6);
  ASSERT_EQ(lens.distortion.size(), 4U);
  EXPECT_NEAR(lens.distortion[0], -0.3 * 1.03 * 1.03, 1e-8);
  EXPECT_NEAR(lens.distortion[1], 0.1 * 1.03 * 1.03 * 1.03 * 1.03, 1e-8);
  EXPECT_NEAR(lens.distortion[2], 0.001 * 1.03, 1e-8);
  EXPECT_NEAR(lens.distortion[3], 0.0, 1e-8);
  EXPECT_LT(largest_error(declared, correction, lens), 1e-6);
}

TEST(CombineLens, ShowsRaysWhereDeclaredLensAndCorrectionDo) {
  const CameraCorrection correction{0.02, 0.003, -0.002, 0.01, 0.0};
  for (const std::size_t coefficients : {4U, 5U}) {
    Lens declared{narrow, barrel};
    declared.distortion.resize(coefficients, 0.0);
    const Lens lens = combined_lens(declared, narrow, correction);
    EXPECT_EQ(lens.distortion.size(), coefficients);
    EXPECT_EQ(lens.camera.width, 640);
    EXPECT_EQ(lens.camera.height, 480);
    EXPECT_GT(largest_error(declared, correction, declared), 3.0);
    EXPECT_LT(largest_error(declared, correction, lens), 0.02);
  }
}

TEST(CombineLens, RefusesWhatNoLensShows) {
  const CameraCorrection correction{0.05, 0.05, -0.04, 0.05, 0.0};
  std::string fault;
  try {
    combined_lens({wide, barrel}, wide, correction);
  } catch (const InputError& e) {
    fault = e.what();
  }
  EXPECT_THAT(fault,
              testing::StartsWith("distortion: no lens of this model is as the images say: the nearest is off by"));
}

}  // namespace
}  // namespace odosplat
