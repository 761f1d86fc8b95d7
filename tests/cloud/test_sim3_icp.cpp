// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/sim3_icp.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/sensor/lidar.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

const SE3 turned_scanner = SE3::exp((Vector6d() << 0, 0, 0, 0.1, -0.2, 1.0).finished());

PointCloud scan(const Scene& scene, int rings, int columns, double noise, std::uint64_t seed) {
  LidarOptions options;
  options.rings = rings;
  options.columns = columns;
  options.elevation_min = -1.5;
  options.elevation_max = 1.5;
  options.range_noise = noise;
  options.colors = false;
  options.seed = seed;
  return simulate_lidar(
      scene, {SE3(Eigen::Quaterniond::Identity(), {0.8, 0.8, 1.2}), SE3(turned_scanner.rotation(), {3.1, 2.2, 1.5})},
      options);
}

const PointCloud& room_cloud() {
  static const PointCloud cloud = scan(make_box_room(7), 80, 160, 0.005, 1);
  return cloud;
}

struct Sparse {
  Similarity cloud_from_points;         // the truth
  std::vector<Eigen::Vector3f> points;  // in another frame and another unit
};

// Points of the room in another frame, with 1 cm of noise; a share `outliers` of them at random places in and around
// the room.
Sparse sparse_points(double outliers, std::uint64_t seed) {
  static const PointCloud surface = scan(make_box_room(7), 40, 80, 0.0, 5);
  Random random(seed);
  Sparse sparse;
  sparse.cloud_from_points = {2.7, SE3::exp((Vector6d() << 3, -1, 0.5, 0.4, -1.2, 2.0).finished())};
  const SE3 back = sparse.cloud_from_points.T_target_source.inverse();
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3d p = surface.points[random.below(static_cast<std::uint32_t>(surface.size()))].cast<double>();
    for (int a = 0; a < 3; ++a) p[a] += 0.01 * random.normal();
    if (random.uniform() < outliers) {
      p = Eigen::Vector3d(random.uniform(-1, 5), random.uniform(-1, 4), random.uniform(-1, 3.5));
    }
    sparse.points.push_back(((back * p) / 2.7).cast<float>());
  }
  return sparse;
}

// The true similarity, disturbed about the middle of the room.
Similarity disturbed(const Similarity& truth, double metres, double degrees, double scale, std::uint64_t seed) {
  Random random(seed);
  const auto direction = [&] {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  const Eigen::Vector3d middle(2, 1.5, 1.25);
  const Eigen::Quaterniond R = so3_exp(degrees * std::numbers::pi / 180.0 * direction());
  const Eigen::Vector3d t = truth.T_target_source.translation();
  return {scale * truth.scale,
          SE3(R * truth.T_target_source.rotation(), middle + metres * direction() + scale * (R * (t - middle)))};
}

struct Error {
  double position_m;  // largest over the room's corners
  double scale;
};

Error error_of(const Similarity& found, const Similarity& truth) {
  Error error{0.0, std::abs(found.scale / truth.scale - 1.0)};
  const SE3 back = truth.T_target_source.inverse();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p(corner & 1 ? 4 : 0, corner & 2 ? 3 : 0, corner & 4 ? 2.5 : 0);
    error.position_m = std::max(error.position_m, (found * Eigen::Vector3d(back * p / truth.scale) - p).norm());
  }
  return error;
}

// 3000 points with 1 cm of noise determine each plane to 0.01 / sqrt(500) = 0.5 mm; at corners beyond the points the
// error is larger.
TEST(Sim3Icp, RecoversTheMotionFromARoughGuess) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Sparse sparse = sparse_points(0.2, seed);
    const double scale = seed % 2 == 0 ? 1.1 : 0.9;
    const Sim3IcpResult r =
        align_to_cloud(sparse.points, room_cloud(), disturbed(sparse.cloud_from_points, 0.2, 10.0, scale, seed));
    SCOPED_TRACE(seed);
    EXPECT_EQ(r.fault, "");
    EXPECT_TRUE(r.converged);
    const Error error = error_of(r.cloud_from_points, sparse.cloud_from_points);
    EXPECT_LT(error.position_m, 0.005);
    EXPECT_LT(error.scale, 0.001);
    EXPECT_EQ(r.points, 3000);
    // Some outliers are near a surface by chance.
    EXPECT_GT(r.inlier_share, 0.79);
    EXPECT_LT(r.inlier_share, 0.88);
    // The median of |normal deviate| of 1 cm is 0.67 cm; outliers among the inliers and the cloud's noise increase it.
    EXPECT_GT(r.median_m, 0.006);
    EXPECT_LT(r.median_m, 0.0085);
    EXPECT_GT(r.rmse_m, r.median_m);
  }
}

TEST(Sim3Icp, ThreadsChangeNoBit) {
  const Sparse sparse = sparse_points(0.1, 3);
  const Similarity guess = disturbed(sparse.cloud_from_points, 0.1, 5.0, 1.05, 3);
  const int before = threads();
  set_threads(1);
  const Sim3IcpResult one = align_to_cloud(sparse.points, room_cloud(), guess);
  set_threads(3);
  const Sim3IcpResult three = align_to_cloud(sparse.points, room_cloud(), guess);
  set_threads(before);
  EXPECT_EQ(one.cloud_from_points.scale, three.cloud_from_points.scale);
  EXPECT_EQ(one.cloud_from_points.T_target_source.matrix(), three.cloud_from_points.T_target_source.matrix());
  EXPECT_EQ(one.rmse_m, three.rmse_m);
}

TEST(Sim3Icp, RefusesAnUnrelatedCloud) {
  // Two concentric spheres of points, about as large as the room.
  Random random(4);
  PointCloud other;
  for (int i = 0; i < 6000; ++i) {
    const Eigen::Vector3d d = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    other.points.push_back((Eigen::Vector3d(2, 1.5, 1.2) + (i % 2 == 0 ? 2.0 : 1.2) * d).cast<float>());
  }
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Sparse sparse = sparse_points(0.1, seed);
    const Sim3IcpResult r = align_to_cloud(sparse.points, other, sparse.cloud_from_points);
    EXPECT_NE(r.fault, "") << r.inlier_share;
  }
}

// Two boxes of different sizes can be aligned on four sides, which hold a share of 0.61 of these points.
TEST(Sim3Icp, RefusesAnotherRoom) {
  const PointCloud other = scan(make_living_room(1), 50, 100, 0.005, 1);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Sparse sparse = sparse_points(0.1, seed);
    const Sim3IcpResult r = align_to_cloud(sparse.points, other, disturbed(sparse.cloud_from_points, 0.5, 20, 1, seed));
    EXPECT_NE(r.fault, "") << r.inlier_share << " " << r.cloud_from_points.scale;
  }
}

TEST(Sim3Icp, RefusesAGuessTooFarOff) {
  const Sparse sparse = sparse_points(0.1, 1);
  for (const double scale : {0.2, 4.0}) {
    const Sim3IcpResult r =
        align_to_cloud(sparse.points, room_cloud(), disturbed(sparse.cloud_from_points, 0.0, 0.0, scale, 1));
    EXPECT_NE(r.fault, "") << scale;
  }
  const Sim3IcpResult far =
      align_to_cloud(sparse.points, room_cloud(), disturbed(sparse.cloud_from_points, 50.0, 0.0, 1.0, 1));
  EXPECT_THAT(far.fault, HasSubstr("only 0.0 %"));
  EXPECT_EQ(far.inliers, 0);
}

// The planes x = 0, y = 0 and z = 0, the first `planes` of them, 3 m wide, and points on them.
Sim3IcpResult on_planes(int planes) {
  Random random(9);
  PointCloud cloud;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 30000; ++i) {
    Eigen::Vector3d p(random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3));
    p[i % planes] = 0.005 * random.normal();
    (i < 27000 ? cloud.points : points).push_back(p.cast<float>());
  }
  return align_to_cloud(points, cloud, {});
}

TEST(Sim3Icp, RefusesSurfacesThatLeaveADirectionOpen) {
  for (const int planes : {1, 2, 3}) {
    const Sim3IcpResult r = on_planes(planes);
    // If the scale is undetermined, noise may make it diverge first.
    EXPECT_THAT(r.fault, testing::AnyOf(HasSubstr("do not determine"), HasSubstr("the scale runs away"))) << planes;
  }
}

TEST(Sim3Icp, RefusesBadInput) {
  const Sparse sparse = sparse_points(0.1, 1);
  const Similarity guess = sparse.cloud_from_points;
  EXPECT_THROW(align_to_cloud({}, room_cloud(), guess), InputError);
  EXPECT_THROW(align_to_cloud(sparse.points, PointCloud(), guess), InputError);
  std::vector<Eigen::Vector3f> holes = sparse.points;
  holes[17].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(align_to_cloud(holes, room_cloud(), guess), InputError);
  EXPECT_THROW(align_to_cloud(sparse.points, room_cloud(), {0.0, SE3()}), InputError);
  for (void (*spoil)(Sim3IcpOptions&) :
       {+[](Sim3IcpOptions& o) { o.radius = 0.0; }, +[](Sim3IcpOptions& o) { o.inlier = -1.0; },
        +[](Sim3IcpOptions& o) { o.min_inliers = 1.5; }, +[](Sim3IcpOptions& o) { o.max_change = 1.0; },
        +[](Sim3IcpOptions& o) { o.max_points = 1; }, +[](Sim3IcpOptions& o) { o.neighbors = 2; },
        +[](Sim3IcpOptions& o) { o.iterations = 0; }}) {
    Sim3IcpOptions options;
    spoil(options);
    EXPECT_THROW(align_to_cloud(sparse.points, room_cloud(), guess, options), InputError);
  }
}

}  // namespace
}  // namespace odosplat
