// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const Camera vga{640, 480, 525.0, 520.0, 319.5, 239.5};

TEST(Camera, RayAndProjectAreInverse) {
  const Eigen::Vector2d pixel(123.25, 77.5);
  EXPECT_LT((vga.project(3.7 * vga.ray(pixel.x(), pixel.y())) - pixel).norm(), 1e-10);
}

TEST(Camera, LevelSeesTheSamePoint) {
  // The centre of the 2x2 block of pixels (10..11, 20..21) is pixel (5, 10) one level up.
  const Eigen::Vector3d p = vga.ray(10.5, 20.5);
  EXPECT_LT((vga.level(1).project(p) - Eigen::Vector2d(5.0, 10.0)).norm(), 1e-10);
  EXPECT_EQ(vga.level(1), vga.resized(320, 240));
  EXPECT_EQ(vga.level(0), vga);
  EXPECT_EQ((Camera{5, 7, 1, 1, 0, 0}.level(1).width), 2);
}

TEST(Camera, BadValuesAreNamed) {
  auto fault = [](Camera c) -> std::string {
    try {
      c.check();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(fault(vga), "");
  Camera c = vga;
  c.fx = 0.0;
  EXPECT_THAT(fault(c), testing::HasSubstr("fx: must be positive"));
  c = vga;
  c.fy = std::nan("");
  EXPECT_THAT(fault(c), testing::HasSubstr("fy"));
  c = vga;
  c.height = 0;
  EXPECT_THAT(fault(c), testing::HasSubstr("height"));
  c = vga;
  c.cx = INFINITY;
  EXPECT_THAT(fault(c), testing::HasSubstr("cx"));
}

}  // namespace
}  // namespace odosplat
