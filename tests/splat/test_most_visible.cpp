// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/most_visible.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace odosplat {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Discs of these radii [m] at these places along x, opacity 0.5.
Gaussians discs(const std::vector<float>& places, const std::vector<float>& radii) {
  Gaussians gaussians;
  gaussians.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    gaussians.positions[3 * i] = places[i];
    gaussians.rotations[4 * i] = 1.0F;
    gaussians.log_scales[3 * i] = gaussians.log_scales[3 * i + 1] = std::log(radii[i]);
    gaussians.log_scales[3 * i + 2] = -9.0F;
  }
  return gaussians;
}

SE3 camera_at(double x) { return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}}; }

TEST(MostVisible, PrefersLargeNearAndOpaqueOnes) {
  EXPECT_THAT(most_visible(discs({1, 1, 1}, {0.1F, 0.3F, 0.2F}), {}, 2).rows, ElementsAre(1, 2));
  EXPECT_THAT(most_visible(discs({4, 1, 9}, {0.1F, 0.1F, 0.1F}), {camera_at(0.0)}, 1).rows, ElementsAre(1));
  EXPECT_THAT(most_visible(discs({4, 1, 9}, {0.1F, 0.1F, 0.1F}), {camera_at(10.0)}, 1).rows, ElementsAre(2));
  Gaussians gaussians = discs({1, 1, 1}, {0.1F, 0.1F, 0.1F});
  gaussians.opacity_logits[2] = 2.0F;
  EXPECT_THAT(most_visible(gaussians, {}, 1).rows, ElementsAre(2));
}

TEST(MostVisible, KeepsTheirOrderAndTellsTheirShare) {
  const VisibleGaussians all = most_visible(discs({1, 1}, {0.1F, 0.1F}), {}, 2);
  EXPECT_THAT(all.rows, ElementsAre(0, 1));
  EXPECT_DOUBLE_EQ(all.share, 1.0);
  const VisibleGaussians some = most_visible(discs({1, 1, 1}, {0.1F, 0.1F, 0.2F}), {}, 2);
  EXPECT_THAT(some.rows, ElementsAre(0, 2)) << "of equal ones the first";
  EXPECT_NEAR(some.share, 5.0 / 6.0, 1e-6);
  EXPECT_THAT(most_visible({}, {}, 3).rows, IsEmpty());
}

TEST(MostVisible, LeavesOutWhatIsNeverDrawn) {
  Gaussians gaussians = discs({1, 1}, {0.1F, 0.1F});
  gaussians.opacity_logits[0] = -6.0F;  // 0.0025, below 1/255
  const VisibleGaussians kept = most_visible(gaussians, {}, 10);
  EXPECT_THAT(kept.rows, ElementsAre(1));
  EXPECT_DOUBLE_EQ(kept.share, 1.0);
}

}  // namespace
}  // namespace odosplat
