// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/splat_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/splat/map_file.hpp"
#include "tests/splat/scratch.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

std::string record(const std::vector<float>& position_scale, const std::vector<int>& bytes) {
  std::string text(4 * position_scale.size(), '\0');
  std::memcpy(text.data(), position_scale.data(), text.size());
  for (const int b : bytes) text += static_cast<char>(b);
  return text;
}

const std::string one = record({1, 2, 3, 0.5F, 0.25F, 0.125F}, {255, 0, 51, 204, 128, 128, 192, 128});

std::string fault(const std::string& bytes) {
  try {
    parse_splat("m.splat", bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SplatFile, ReadsWhatTheBytesSay) {
  const Gaussians g = parse_splat("m.splat", one);
  ASSERT_EQ(g.size(), 1U);
  EXPECT_EQ(g.sh_degree, 0);
  EXPECT_THAT(g.positions, testing::ElementsAre(1, 2, 3));
  EXPECT_NEAR(g.log_scales[0], std::log(0.5), 1e-6);
  EXPECT_NEAR(g.log_scales[2], std::log(0.125), 1e-6);
  EXPECT_NEAR(0.5 + 0.28209479 * static_cast<double>(g.sh[0]), 1.0, 1e-6);
  EXPECT_NEAR(0.5 + 0.28209479 * static_cast<double>(g.sh[1]), 0.0, 1e-6);
  EXPECT_NEAR(0.5 + 0.28209479 * static_cast<double>(g.sh[2]), 0.2, 1e-6);
  EXPECT_NEAR(1.0 / (1.0 + std::exp(-static_cast<double>(g.opacity_logits[0]))), 0.8, 1e-6);
  EXPECT_THAT(g.rotations, testing::ElementsAre(0, 0, 1, 0));  // w x y z, of unit length
}

TEST(SplatFile, OpacitiesOfNoneAndAllStayFinite) {
  std::string bytes = one + one;
  bytes[27] = 0;
  bytes[32 + 27] = static_cast<char>(255);
  const Gaussians g = parse_splat("m.splat", bytes);
  EXPECT_LT(g.opacity_logits[0], -6.0F);
  EXPECT_GT(g.opacity_logits[1], 6.0F);
  EXPECT_EQ(static_cast<unsigned char>(splat_bytes(g)[27]), 255);
  EXPECT_EQ(splat_bytes(g)[32 + 27], 0);
}

TEST(SplatFile, WritesLargestFirstAndEqualsInOrder) {
  std::string bytes;
  for (const int opacity : {10, 200, 200, 100}) {
    bytes += record({static_cast<float>(bytes.size()), 0, 0, 1, 1, 1}, {0, 0, 0, opacity, 255, 128, 128, 128});
  }
  const Gaussians sorted = parse_splat("m.splat", splat_bytes(parse_splat("m.splat", bytes)));
  EXPECT_THAT(sorted.positions, testing::ElementsAre(32, 0, 0, 64, 0, 0, 96, 0, 0, 0, 0, 0));
}

TEST(SplatFile, BytesComeBackTheSame) {
  // All byte values of colour and opacity. Unit quaternions keep the resolution of the bytes.
  Random random(4);
  Gaussians g;
  g.resize(256);
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      g.positions[3 * i + a] = static_cast<float>(random.normal());
      g.log_scales[3 * i + a] = static_cast<float>(random.uniform(-6, 0));
      g.sh[3 * i + a] = (static_cast<float>((i * (a + 1)) % 256) / 255.0F - 0.5F) / 0.28209479F;
    }
    for (std::size_t a = 0; a < 4; ++a) g.rotations[4 * i + a] = static_cast<float>(random.normal());
    g.opacity_logits[i] = static_cast<float>(random.normal());
  }
  const std::string bytes = splat_bytes(g);
  const Gaussians back = parse_splat("m.splat", bytes);
  const std::string again = splat_bytes(back);
  ASSERT_EQ(again.size(), bytes.size());
  for (std::size_t i = 0; i < 256; ++i) {
    const std::string a = bytes.substr(32 * i, 32);
    // The order may change if two opacities round to the same byte: the Gaussian is looked up by its position.
    const std::size_t at = again.find(a.substr(0, 12));
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(again.substr(at + 24, 4), a.substr(24, 4));
    for (std::size_t k = 28; k < 32; ++k) {
      EXPECT_LE(std::abs(static_cast<unsigned char>(again[at + k]) - static_cast<unsigned char>(a[k])), 1);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      float before = 0;
      float after = 0;
      std::memcpy(&before, &a[12 + 4 * k], 4);
      std::memcpy(&after, &again[at + 12 + 4 * k], 4);
      EXPECT_NEAR(after, before, 2e-6F * before);
    }
  }
}

TEST(SplatFile, ExtremeGaussiansStayInRange) {
  Gaussians g;
  g.resize(4);
  constexpr float huge = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < 4; ++i) {
    const float value = i % 2 == 0 ? huge : -huge;
    for (std::size_t a = 0; a < 3; ++a) g.log_scales[3 * i + a] = g.sh[3 * i + a] = value;
    for (std::size_t a = 0; a < 4; ++a) g.rotations[4 * i + a] = i < 2 ? value : 0.0F;
    g.opacity_logits[i] = i < 2 ? value : -value;
  }
  const std::string bytes = splat_bytes(g);
  ASSERT_EQ(bytes.size(), 4U * 32U);
  for (std::size_t i = 0; i < 4; ++i) {
    float values[6];
    std::memcpy(values, bytes.data() + 32 * i, sizeof(values));
    for (const float value : values) EXPECT_TRUE(std::isfinite(value)) << i;
  }
}

TEST(SplatFile, FaultsAreNamed) {
  EXPECT_EQ(fault(""), "m.splat: holds no Gaussians");
  for (std::size_t n = 1; n < 32; ++n) {
    EXPECT_EQ(fault(one + one.substr(0, n)),
              "m.splat: has " + std::to_string(32 + n) + " bytes, no multiple of 32: cut off, or no .splat");
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<int> bytes{128, 128, 128, 128, 255, 128, 128, 128};
  EXPECT_EQ(fault(one + record({nan, 0, 0, 1, 1, 1}, bytes)), "m.splat: Gaussian 1: its position is not finite");
  EXPECT_EQ(fault(record({0, 0, 0, 1, 1, -1}, bytes)), "m.splat: Gaussian 0: its scale is negative or not finite");
  EXPECT_EQ(fault(record({0, 0, 0, 1, nan, 1}, bytes)), "m.splat: Gaussian 0: its scale is negative or not finite");
  EXPECT_EQ(parse_splat("m.splat", record({0, 0, 0, 1, 1, 0}, bytes)).log_scales[2], -23.0F);
}

TEST(SplatFile, WhatCannotBeDrawnIsBroken) {
  const std::vector<int> upright{128, 128, 128, 128, 255, 128, 128, 128};
  EXPECT_EQ(fault(record({0, 0, 0, 1, 1, 1}, std::vector<int>(8, 128))),
            "m.splat: Gaussian 0: its rotation has length 0");
  EXPECT_EQ(fault(record({0, 1e38F, 0, 1, 1, 1}, upright)),
            "m.splat: Gaussian 0: its position [m] is 1e+38, beyond 1e+07");
  EXPECT_EQ(fault(record({0, 0, 0, 1, 5.5e34F, 1}, upright)),
            "m.splat: Gaussian 0: its scale [ln m] is 80, beyond 13.8");
}

TEST(SplatFile, AFewBrokenRowsAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string bytes;
  for (int i = 0; i < 10; ++i) bytes += i == 4 ? record({nan, 0, 0, 1, 1, 1}, std::vector<int>(8, 128)) : one;
  EXPECT_EQ(parse_splat("m.splat", bytes).size(), 9U);
}

TEST(SplatFile, MapsAreReadAndWrittenByExtension) {
  const test::Scratch scratch;
  const Gaussians g = parse_splat("m.splat", one);
  write_map(scratch / "m.SPLAT", g);
  EXPECT_EQ(read_map(scratch / "m.SPLAT").gaussians.positions, g.positions);
  write_map(scratch / "m.ply", g);
  EXPECT_EQ(read_map(scratch / "m.ply").gaussians.sh, g.sh);
  EXPECT_TRUE(is_map_file(scratch / "m.SPLAT"));
  EXPECT_TRUE(is_map_file(scratch / "m.ply"));
  EXPECT_FALSE(is_map_file(scratch / "none.ply"));
  EXPECT_FALSE(is_map_file("/"));
}

// Maps trained by other programs, with variations of the format.
TEST(SplatFile, MapsOfOtherProgramsAreRead) {
  const test::Scratch scratch;
  for (int degree = 0; degree <= 3; ++degree) {
    // Doubles, no normals, additional properties, another element after the vertices.
    PlyElement vertex;
    vertex.name = "vertex";
    vertex.add("label", std::vector<std::int32_t>{7, 8});
    const auto k = static_cast<std::size_t>(sh_coefficients(degree));
    double value = 0.0;
    const auto add = [&](const std::string& name) { vertex.add(name, std::vector<double>{value += 0.125, -value}); };
    for (const char* name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2"}) add(name);
    for (std::size_t i = 0; i < 3 * (k - 1); ++i) add("f_rest_" + std::to_string(i));
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"}) add(name);
    PlyElement camera;
    camera.name = "camera";
    camera.add("fx", std::vector<float>{500.0F});
    Ply ply;
    ply.elements = {vertex, camera};
    write_ply(scratch / "other.ply", ply);
    EXPECT_TRUE(is_map_file(scratch / "other.ply"));
    const Gaussians g = read_map(scratch / "other.ply").gaussians;
    ASSERT_EQ(g.size(), 2U);
    EXPECT_EQ(g.sh_degree, degree);
    EXPECT_EQ(g.positions[2], 0.375F);
    EXPECT_EQ(g.positions[5], -0.375F);
    EXPECT_EQ(g.sh[2], 0.75F);
    EXPECT_EQ(g.opacity_logits[0], static_cast<float>(0.125 * static_cast<double>(3 * k + 4)));
    EXPECT_EQ(g.rotations[7], static_cast<float>(-0.125 * static_cast<double>(3 * k + 11)));
    if (degree == 0) continue;
    EXPECT_EQ(g.sh[3], 0.875F);                                                          // coefficient 1 of red
    EXPECT_EQ(g.sh[4], static_cast<float>(0.875 + 0.125 * static_cast<double>(k - 1)));  // and of green
  }
}

}  // namespace
}  // namespace odosplat
