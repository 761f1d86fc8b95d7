// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/lighting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {
namespace {

LightingOptions direct_only() {
  LightingOptions options;
  options.bounces = 0;
  options.light_samples = 1024;
  options.texel_m = 0.2F;
  return options;
}

Eigen::Vector3f light_below(const Scene& scene, float x, float y) {
  RayHit hit;
  EXPECT_TRUE(scene.closest({Eigen::Vector3f(x, y, 0.1F), -Eigen::Vector3f::UnitZ()}, hit));
  return scene.light(hit);
}

TEST(Lighting, RectangleAboveAFloorFollowsTheFormFactor) {
  SceneBuilder builder;
  builder.add_quad({-1.1F, 1.1F, 0.0F}, {2.2F, 0.0F, 0.0F}, {0.0F, -2.2F, 0.0F}, builder.add_plain(1.0F, 1.0F, 1.0F));
  // 1.2 x 0.8 m at a height of 1.5 m, shining down.
  builder.add_window_light({-0.6F, -0.4F, 1.5F}, {1.2F, 0.0F, 0.0F}, {0.0F, 0.8F, 0.0F}, {5.0F, 4.0F, 3.0F});
  const Scene scene = builder.build(direct_only());
  // Form factor from a point to a parallel rectangle with a corner above it, four times (textbook formula).
  const double x = 0.6 / 1.5;
  const double y = 0.4 / 1.5;
  const double a = x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x));
  const double b = y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y));
  const double factor = 4.0 * (a + b) / (2.0 * 3.14159265358979);
  const Eigen::Vector3f light = light_below(scene, 0.0F, 0.0F);
  EXPECT_NEAR(light.x(), 5.0 * factor, 0.01 * 5.0 * factor);
  EXPECT_NEAR(light.y(), 4.0 * factor, 0.01 * 4.0 * factor);
  EXPECT_NEAR(light.z(), 3.0 * factor, 0.01 * 3.0 * factor);
}

TEST(Lighting, LampFallsWithTheSquareOfDistance) {
  SceneBuilder builder;
  builder.add_quad({-2.1F, 2.1F, 0.0F}, {4.2F, 0.0F, 0.0F}, {0.0F, -4.2F, 0.0F}, builder.add_plain(1.0F, 1.0F, 1.0F));
  builder.add_lamp({0.0F, 0.0F, 1.2F}, 0.05F, {100.0F, 100.0F, 100.0F});
  const Scene scene = builder.build(direct_only());
  for (const float x : {0.0F, 0.6F, 1.4F}) {
    const double d2 = 1.2 * 1.2 + x * x;
    const double expected = 100.0 * 0.05 * 0.05 / d2 * (1.2 / std::sqrt(d2));
    EXPECT_NEAR(light_below(scene, x, 0.0F).x(), expected, 0.03 * expected);
  }
}

TEST(Lighting, ThingsThrowShadowsUnlessToldNotTo) {
  for (const bool casts : {true, false}) {
    SceneBuilder builder;
    Material blind;
    blind.casts_shadow = casts;
    builder.add_quad({-2.0F, 2.0F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, -4.0F, 0.0F}, builder.add_plain(1.0F, 1.0F, 1.0F));
    const int m = builder.add_material(blind);
    builder.add_quad({-0.3F, 0.3F, 0.5F}, {0.6F, 0.0F, 0.0F}, {0.0F, -0.6F, 0.0F}, m);
    builder.add_lamp({0.0F, 0.0F, 1.0F}, 0.05F, {100.0F, 100.0F, 100.0F});
    const Scene scene = builder.build(direct_only());
    if (casts) {
      EXPECT_EQ(light_below(scene, 0.0F, 0.0F).x(), 0.0F);
    } else {
      EXPECT_GT(light_below(scene, 0.0F, 0.0F).x(), 0.2F);
    }
    EXPECT_GT(light_below(scene, 1.5F, 0.0F).x(), 0.02F);
  }
}

TEST(Lighting, ReflectedLightOfAClosedRoomApproachesTheGeometricSeries) {
  // In a sphere of albedo a, the light after n reflections is everywhere the mean of the direct light times a + ... +
  // a^n.
  auto mean_light = [](int bounces) {
    SceneBuilder builder;
    Material material;
    material.tint = Eigen::Vector3f::Constant(from_linear(0.5F));
    const int m = builder.add_material(material);
    // For a sphere seen from inside, u runs in the other direction.
    SceneBuilder::Surface inside;
    inside.position = [](float u, float v) -> Eigen::Vector3f {
      const float a = -6.2831853F * u;
      const float b = 3.14159265F * v;
      return {std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)};
    };
    inside.normal = [=](float u, float v) -> Eigen::Vector3f { return -inside.position(u, v); };
    inside.segments_u = 256;  // facets must be closer to the sphere than the height at which light is sampled above it
    inside.segments_v = 128;
    inside.size_m = {3.0F, 3.0F};
    inside.material = m;
    builder.add_surface(inside);
    builder.add_lamp(Eigen::Vector3f::Zero(), 0.1F, {100.0F, 100.0F, 100.0F});
    LightingOptions options;
    options.bounces = bounces;
    options.texel_m = 0.3F;
    options.gather_samples = 64;
    const Scene scene = builder.build(options);
    double sum = 0.0;
    int n = 0;
    for (const Eigen::Vector3f& l : scene.content().patches[0].light) {
      sum += l.x();
      ++n;
    }
    return sum / n;
  };
  const double direct = mean_light(0);
  EXPECT_NEAR(direct, 100.0 * 0.01, 0.03);
  EXPECT_NEAR(mean_light(1) / direct, 1.5, 0.03);
  EXPECT_NEAR(mean_light(3) / direct, 1.875, 0.05);
}

TEST(Lighting, SameBitsForAnyNumberOfThreads) {
  auto build = [] {
    SceneBuilder builder;
    const int plain = builder.add_plain(0.7F, 0.6F, 0.5F);
    builder.add_quad({-1.0F, 1.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, -2.0F, 0.0F}, plain);
    builder.add_cushion({0.2F, 0.1F, 0.3F}, {0.3F, 0.2F, 0.2F}, 0.4F, plain, 8);
    builder.add_lamp({0.4F, 0.2F, 1.0F}, 0.05F, {60.0F, 60.0F, 50.0F});
    return builder.build({});
  };
  const int before = threads();
  set_threads(1);
  const Scene a = build();
  set_threads(2);
  const Scene b = build();
  set_threads(before);
  ASSERT_EQ(a.content().patches.size(), b.content().patches.size());
  for (std::size_t i = 0; i < a.content().patches.size(); ++i) {
    EXPECT_TRUE(a.content().patches[i].light == b.content().patches[i].light);
  }
}

TEST(Lighting, RefusesWrongOptions) {
  SceneBuilder builder;
  LightingOptions options;
  options.texel_m = 0.0F;
  EXPECT_THROW(builder.build(options), InputError);
  options = {};
  options.exposure = 0.0F;
  EXPECT_THROW(builder.build(options), InputError);
}

}  // namespace
}  // namespace odosplat
