// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/bvh.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

/// Nearest hit by solving each triangle's 3x3 system in double. sure: false if the ray passes close to a triangle's
/// border.
struct Answer {
  int triangle = -1;
  double t = 1e30;
  bool sure = true;
};

Answer by_force(const std::vector<Bvh::Triangle>& triangles, const Ray& ray) {
  Answer answer;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Eigen::Matrix3d M;
    M.col(0) = (triangles[i][1] - triangles[i][0]).cast<double>();
    M.col(1) = (triangles[i][2] - triangles[i][0]).cast<double>();
    M.col(2) = -ray.direction.cast<double>();
    if (std::abs(M.determinant()) < 1e-12) continue;
    const Eigen::Vector3d x = M.inverse() * (ray.origin - triangles[i][0]).cast<double>();
    const double inside = std::min({x[0], x[1], 1.0 - x[0] - x[1]});
    if (x[2] <= ray.t_min || x[2] >= ray.t_max) continue;
    if (std::abs(inside) < 1e-3) answer.sure = false;
    if (inside < 0.0) continue;
    if (x[2] < answer.t) {
      answer.t = x[2];
      answer.triangle = static_cast<int>(i);
    }
  }
  return answer;
}

Eigen::Vector3f random_point(Random& random, double half) {
  const double x = random.uniform(-half, half);
  const double y = random.uniform(-half, half);
  const double z = random.uniform(-half, half);
  return Eigen::Vector3d(x, y, z).cast<float>();
}

std::vector<Bvh::Triangle> random_triangles(Random& random, int n, double size) {
  std::vector<Bvh::Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3f p = random_point(random, 2.0);
    triangles.push_back({p, p + random_point(random, size), p + random_point(random, size)});
  }
  return triangles;
}

class BvhSizes : public testing::TestWithParam<int> {};

TEST_P(BvhSizes, ClosestEqualsBruteForce) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 5);
  const std::vector<Bvh::Triangle> triangles = random_triangles(random, GetParam(), 0.7);
  const Bvh bvh(triangles);
  int hits = 0;
  int judged = 0;
  for (int k = 0; k < 3000; ++k) {
    Ray ray{random_point(random, 3.0), random_point(random, 1.0)};
    if (k % 5 == 0) ray.direction[k % 3] = 0.0F;  // parallel to a plane of two axes
    if (k % 7 == 0) ray.t_max = 2.0F;
    const Answer expected = by_force(triangles, ray);
    if (!expected.sure) continue;
    ++judged;
    RayHit hit;
    const bool found = bvh.closest(ray, hit);
    ASSERT_EQ(found, expected.triangle >= 0) << "ray " << k;
    EXPECT_EQ(bvh.any(ray), found);
    if (!found) continue;
    ++hits;
    EXPECT_EQ(hit.triangle, expected.triangle);
    EXPECT_NEAR(hit.t, expected.t, 1e-4 * (1.0 + expected.t));
    RayHit hinted;
    ASSERT_TRUE(bvh.closest(ray, hinted, k % GetParam()));
    EXPECT_EQ(hinted.triangle, hit.triangle);
    EXPECT_EQ(hinted.t, hit.t);
  }
  EXPECT_GT(judged, 1500);
  EXPECT_GT(hits, 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, BvhSizes, testing::Values(1, 2, 5, 64, 700));

TEST(Bvh, EmptyIsNeverHit) {
  const Bvh bvh(std::vector<Bvh::Triangle>{});
  RayHit hit;
  EXPECT_FALSE(bvh.closest({Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()}, hit));
  EXPECT_FALSE(bvh.any({Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()}));
}

TEST(Bvh, ManyTrianglesInOnePlaceAreAllKept) {
  const Bvh::Triangle triangle{Eigen::Vector3f(1.0F, -1.0F, -1.0F), Eigen::Vector3f(1.0F, 2.0F, -1.0F),
                               Eigen::Vector3f(1.0F, -1.0F, 2.0F)};
  std::vector<Bvh::Triangle> triangles(100, triangle);
  for (Eigen::Vector3f& p : triangles[77]) p.x() = 0.5F;
  const Bvh bvh(triangles);
  RayHit hit;
  ASSERT_TRUE(bvh.closest({Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()}, hit));
  EXPECT_EQ(hit.triangle, 77);
  EXPECT_FLOAT_EQ(hit.t, 0.5F);
}

TEST(Bvh, RaysDoNotSlipBetweenNeighbours) {
  // A wavy sheet of 40 x 40 cells; every ray aims at a shared edge or corner.
  std::vector<Bvh::Triangle> triangles;
  auto point = [](double i, double j) {
    return Eigen::Vector3d(0.1 * i, 0.1 * j, 0.2 * std::sin(0.9 * i) * std::cos(0.7 * j)).cast<float>().eval();
  };
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) {
      triangles.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      triangles.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  const Bvh bvh(triangles);
  Random random(9);
  int missed = 0;
  for (int k = 0; k < 20000; ++k) {
    const int i = 2 + static_cast<int>(random.below(36));
    const int j = 2 + static_cast<int>(random.below(36));
    const auto s = static_cast<float>(random.uniform());
    const Eigen::Vector3f a = point(i, j);
    const Eigen::Vector3f b = k % 3 == 0 ? point(i + 1, j) : k % 3 == 1 ? point(i, j + 1) : point(i + 1, j + 1);
    const Eigen::Vector3f origin(1.9F, 2.1F, 5.0F);
    RayHit hit;
    if (!bvh.closest({origin, (1.0F - s) * a + s * b - origin}, hit)) ++missed;
  }
  EXPECT_EQ(missed, 0);
}

TEST(Bvh, OpaqueFlagsConcernShadowsAlone) {
  const Bvh::Triangle triangle{Eigen::Vector3f(1.0F, -1.0F, -1.0F), Eigen::Vector3f(1.0F, 2.0F, -1.0F),
                               Eigen::Vector3f(1.0F, -1.0F, 2.0F)};
  const Bvh bvh({triangle}, {0});
  RayHit hit;
  EXPECT_TRUE(bvh.closest({Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()}, hit));
  EXPECT_FALSE(bvh.any({Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()}));
}

}  // namespace
}  // namespace odosplat
