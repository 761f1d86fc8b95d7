// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/row_shift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/confirm/map_confirmation.hpp"
#include "odosplat/odometry/points/immature_points.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

/// Root mean square difference [grey], away from the edges.
double difference(const GrayImage& a, const GrayImage& b) {
  constexpr int border = 6;
  double squares = 0.0;
  int count = 0;
  for (int v = border; v < a.rows - border; ++v) {
    for (int u = border; u < a.cols - border; ++u) {
      squares += std::pow(a(v, u) - b(v, u), 2);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

class RowShiftTest : public testing::Test {
 protected:
  RowShiftTest() {
    camera_.readout = 0.02;
    velocity_ << 0.4, 0.2, 0.3, 0.5, 1.2, 0.3;
    row_motion_ = camera_.readout * velocity_;
  }
  /// Image of the rolling shutter.
  FramePyramid taken() const {
    const auto path = [&](double s) { return (SE3::exp(s * velocity_) * T_world_camera_.inverse()).inverse(); };
    return with_row_motion(build_frame_pyramid(camera_, room_.gray(camera_, path)), row_motion_);
  }

  Camera camera_ = test::small_camera();
  mutable test::BoxRoom room_;
  SE3 T_world_camera_ = test::room_path(20);
  Vector6d velocity_;
  Vector6d row_motion_;
};

TEST_F(RowShiftTest, PutsAPointWhereItsOwnRowSeesIt) {
  const RowShift<double> rows(camera_, row_motion_);
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.5, 0.6, 1.5), {-0.7, -1.2, 3.0}, {0.0, 0.0, 2.0}}) {
    const Eigen::Vector3d q = rows.at(p);
    const double s = camera_.time_of_row(camera_.project(q).y());
    EXPECT_LT((q - SE3::exp(s * row_motion_) * p).norm(), 2e-5);
    const SE3 T_row = at_its_row(SE3(), camera_, p, row_motion_);
    EXPECT_LT((q - T_row * p).norm(), 2e-3);  // the row is that of the middle row's camera
  }
  const Eigen::Vector3d behind(0.1, 0.2, -1.0);
  EXPECT_EQ(rows.at(behind), behind);
  const Eigen::Vector3d p(0.5, 0.6, 1.5);
  EXPECT_EQ(RowShift<double>(camera_, Vector6d::Zero()).at(p), p);
}

TEST_F(RowShiftTest, ShiftsOnEveryLevelAlike) {
  const Eigen::Vector3d p(0.5, 0.6, 1.5);
  EXPECT_LT(
      (RowShift<double>(camera_.level(2), row_motion_).at(p) - RowShift<double>(camera_, row_motion_).at(p)).norm(),
      1e-12);
}

TEST_F(RowShiftTest, TakesAllRowsTogether) {
  const FramePyramid image = taken();
  const GrayImage still = room_.gray(camera_, T_world_camera_);
  const DepthImage depth = room_.render(camera_, T_world_camera_, {false, false}).depth;
  const FramePyramid together = with_rows_together(image, depth);
  EXPECT_TRUE(together.row_motion.isZero());
  EXPECT_EQ(together.levels(), image.levels());
  const double before = difference(image.gray.front(), still);
  EXPECT_GT(before, 0.02);
  // cv::remap places pixels to 1/32 px.
  EXPECT_LT(difference(together.gray.front(), still), 0.1 * before);
  // Without depth the turning alone is taken out, and with the mean depth some of the rest.
  EXPECT_LT(difference(with_rows_together(image, {}).gray.front(), still), 0.5 * before);
}

TEST_F(RowShiftTest, AlignsTheImageOfARollingShutter) {
  const SE3 T_world_host = test::room_path(14);
  const FramePyramid host = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host));
  PixelSelector selector({});
  const TrackingReference reference =
      build_reference(host, build_gradients(host), room_.render(camera_, T_world_host, {}), selector, {}, {});
  const ImageAligner aligner({});
  const SE3 truth = T_world_camera_.inverse() * T_world_host;
  const auto error = [&](const FramePyramid& image) {
    const Alignment found = aligner.align(reference, image, SE3(), {}, 5, 0);
    EXPECT_TRUE(found.finished);
    return (truth.inverse() * found.T_target_host).log().norm();
  };
  const double rolling = error(taken());
  EXPECT_LT(rolling, 0.001);
  EXPECT_GT(error(with_row_motion(taken(), Vector6d::Zero())), 5.0 * rolling);
}

TEST_F(RowShiftTest, IsComparedWithTheMapRowByRow) {
  const ViewPatches patches(camera_, {T_world_camera_, room_.render(camera_, T_world_camera_, {true, false})}, 0.0, {});
  const double rolling = patches.compare(taken(), T_world_camera_).score;
  EXPECT_GT(rolling, 0.98);
  EXPECT_LT(patches.compare(with_row_motion(taken(), Vector6d::Zero()), T_world_camera_).score, rolling - 0.01);
}

TEST_F(RowShiftTest, PointsAreSearchedWhereTheirRowSeesThem) {
  const SE3 T_world_host = test::room_path(14);
  const FramePyramid host = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host));
  const auto gradients = build_gradients(host);
  PixelSelector selector({});
  const auto error = [&](const FramePyramid& image) {
    std::vector<ImmaturePoint> points = make_immature_points(gradients, {}, 50.0 / 255, selector, {});
    for (ImmaturePoint& point : points) {
      const double q = 1.0 / room_.depth(camera_, T_world_host, point.u, point.v);
      point.min_q = 0.7 * q;
      point.max_q = 1.4 * q;
    }
    trace_points(points, T_world_camera_.inverse() * T_world_host, image, {}, {});
    double sum = 0.0;
    int found = 0;
    for (const ImmaturePoint& point : points) {
      if (point.found == 0) continue;
      const double q = 1.0 / room_.depth(camera_, T_world_host, point.u, point.v);
      sum += std::abs(0.5 * (point.min_q + point.max_q) / q - 1.0);
      ++found;
    }
    EXPECT_GT(found, 50);
    return sum / std::max(1, found);
  };
  EXPECT_LT(2.0 * error(taken()), error(with_row_motion(taken(), Vector6d::Zero())));
}

}  // namespace
}  // namespace odosplat
