// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/core/random.hpp"
#include "odosplat/odometry/points/map_plane.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

/// Depth of the plane normal . p = distance [m] seen by the camera.
DepthImage plane_depth(const Camera& camera, const Eigen::Vector3d& normal, double distance) {
  DepthImage depth(camera.height, camera.width);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) depth(y, x) = static_cast<float>(distance / normal.dot(camera.ray(x, y)));
  }
  return depth;
}

TEST(MapPlane, FitIsExactOnPlanes) {
  const Camera camera = test::small_camera();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.4, -0.3, 0.9).normalized();
  const DepthImage depth = plane_depth(camera, normal, 2.0);
  for (const int stride : {1, 2, 4}) {
    const auto surface = fit_surface(camera, depth, {}, 60, 70, stride, {});
    ASSERT_TRUE(surface.has_value());
    EXPECT_LT((surface->m_camera - normal / 2.0).norm(), 1e-4);
    EXPECT_NEAR(surface->inverse_depth, 1.0 / depth(70, 60), 1e-6);
    // sigma has a lower limit.
    EXPECT_NEAR(surface->sigma, MapPlaneOptions().relative_floor * surface->inverse_depth, 1e-4);
  }
}

TEST(MapPlane, NoiseIsAveragedAndShowsInSigma) {
  const Camera camera = test::small_camera();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.2, 1.0).normalized();
  const DepthImage clean = plane_depth(camera, normal, 2.5);
  DepthImage depth = clean.clone();
  Random random(5);
  const double noise = 0.01;
  for (float& z : depth) z += static_cast<float>(noise * random.normal());
  double squares = 0.0;
  int n = 0;
  for (int y = 10; y < 110; y += 5) {
    for (int x = 10; x < 150; x += 5, ++n) {
      const auto surface = fit_surface(camera, depth, {}, x, y, 1, {});
      ASSERT_TRUE(surface.has_value());
      const double error = 1.0 / surface->inverse_depth - clean(y, x);
      squares += error * error;
      EXPECT_GT(surface->sigma, 0.3 * noise * surface->inverse_depth * surface->inverse_depth);
    }
  }
  EXPECT_LT(std::sqrt(squares / n), 0.4 * noise);
}

TEST(MapPlane, EdgesBelongToTheSurfaceInFront) {
  const Camera camera = test::small_camera();
  DepthImage depth(camera.height, camera.width, 3.0F);
  depth(cv::Rect(0, 0, 80, camera.height)).setTo(1.5F);
  for (const int x : {79, 80}) {  // the last pixel of the front surface, the first of the rear one
    const auto surface = fit_surface(camera, depth, {}, x, 60, 1, {});
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(surface->edge);
    EXPECT_NEAR(surface->inverse_depth, 1.0 / 1.5, 1e-3);
  }
  EXPECT_FALSE(fit_surface(camera, depth, {}, 70, 60, 1, {})->edge);
  EXPECT_FALSE(fit_surface(camera, depth, {}, 90, 60, 1, {})->edge);
}

TEST(MapPlane, NothingWithoutTrustedDepth) {
  const Camera camera = test::small_camera();
  DepthImage depth(camera.height, camera.width, 0.0F);
  EXPECT_FALSE(fit_surface(camera, depth, {}, 60, 70, 1, {}).has_value());
  depth(70, 60) = 2.0F;  // a single pixel with depth
  EXPECT_FALSE(fit_surface(camera, depth, {}, 60, 70, 1, {}).has_value());
  depth.setTo(2.0F);
  const cv::Mat1f sigma(camera.height, camera.width, 0.5F);
  EXPECT_FALSE(fit_surface(camera, depth, sigma, 60, 70, 1, {}).has_value());
  const cv::Mat1f small_sigma(camera.height, camera.width, 0.005F);
  EXPECT_TRUE(fit_surface(camera, depth, small_sigma, 60, 70, 1, {}).has_value());
}

TEST(MapPlane, WorksAtTheImageCorner) {
  const Camera camera = test::small_camera();
  const DepthImage depth = plane_depth(camera, {0, 0, 1}, 2.0);
  const auto surface = fit_surface(camera, depth, {}, 0, 0, 1, {});
  ASSERT_TRUE(surface.has_value());
  EXPECT_NEAR(surface->inverse_depth, 0.5, 1e-6);
}

TEST(MapPlane, WorldAndCameraFormsAreTheSamePlane) {
  const SE3 T_world_camera(so3_exp({0.3, -0.8, 0.2}), {1.0, -2.0, 0.5});
  const Eigen::Vector3d m(0.1, -0.05, 0.4);
  const Plane plane = world_plane(m, T_world_camera);
  const Eigen::Vector3d on_plane = m / m.squaredNorm();
  EXPECT_NEAR(plane.N.dot(T_world_camera * on_plane), plane.D, 1e-12);
  EXPECT_LT((plane_in_camera(plane, T_world_camera) - m).norm(), 1e-12);
  const SE3 T_world_other(so3_exp({0.1, 0.2, -0.3}), {0.7, -1.5, 0.2});
  const Eigen::Vector3d in_other = T_world_other.inverse() * (T_world_camera * on_plane);
  EXPECT_NEAR(plane_in_camera(plane, T_world_other).dot(in_other), 1.0, 1e-12);
}

}  // namespace
}  // namespace odosplat
