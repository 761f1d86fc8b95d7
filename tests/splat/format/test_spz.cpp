// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/spz.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "odosplat/io/archive/compression.hpp"
#include "odosplat/splat/map.hpp"
#include "tests/splat/format/made_map.hpp"

namespace odosplat {
namespace {

using test::bytes_of;
using test::fault_of;
using test::little;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> header{"odosplat map, format 1", "blend_order distance", "sigma_spread 0.7"};

std::string head(std::uint32_t version, std::uint32_t count, int degree, int bits = 12, int flags = 0) {
  return "NGSP" + little(version) + little(count) + bytes_of({degree, bits, flags, 0});
}

/// One Gaussian at (1, 2, -3) in the axes of SPZ, as versions 1 to 3 store it.
std::string old_file(std::uint32_t version, int degree = 0, int flags = 0) {
  const std::string position = version == 1 ? bytes_of({0x00, 0x3C, 0x00, 0x40, 0x00, 0xC2})  // half floats
                                            : bytes_of({0x00, 0x10, 0x00, 0x00, 0x20, 0x00, 0x00, 0xD0, 0xFF});
  // Half a turn about y and x, in that proportion: (x y z w) = (0.6, 0.8, 0, 0) and its rounding.
  const std::string rotation = version < 3 ? bytes_of({204, 230, 128}) : little<std::uint32_t>(0);
  std::string sh;
  for (int j = 0; j < 3 * ((degree + 1) * (degree + 1) - 1); ++j) sh += static_cast<char>(128 + j);
  return test::gzip(head(version, 1, degree, 12, flags) + position + bytes_of({204, 255, 0, 127, 144, 160, 176}) +
                    rotation + sh);
}

TEST(Spz, EarlierVersionsAreReadAsTheirBytesSay) {
  for (const std::uint32_t version : {1U, 2U, 3U}) {
    const Gaussians g = parse_spz("m.spz", old_file(version)).gaussians;
    ASSERT_EQ(g.size(), 1U);
    EXPECT_THAT(g.positions, ElementsAre(1, -2, 3)) << version;  // y and z of a PLY point the other way
    EXPECT_NEAR(test::opacity(g, 0), 0.8, 1e-6);
    EXPECT_THAT(g.log_scales, ElementsAre(-1, 0, 1));
    EXPECT_NEAR(g.sh[0], 0.5 / 0.15, 1e-6);
    EXPECT_NEAR(g.sh[1], -0.5 / 0.15, 1e-6);
    if (version < 3) {
      EXPECT_NEAR(g.rotations[1], 204 / 127.5 - 1.0, 1e-6);
      EXPECT_NEAR(g.rotations[2], -(230 / 127.5 - 1.0), 1e-6);
      EXPECT_NEAR(g.rotations[3], -(128 / 127.5 - 1.0), 1e-6);
      EXPECT_NEAR(g.rotations[0], 0.0, 0.1);
    } else {
      EXPECT_THAT(g.rotations, ElementsAre(0, 1, 0, 0));  // index 0 is x; the others are 0
    }
  }
}

TEST(Spz, TheThreeSmallestComponentsFollowTheIndexOfTheLargest) {
  // Index 2 (z); x = 511, y = -256, w = 0 in steps of 1/(511 sqrt(2)).
  const std::uint32_t packed = 2U << 30U | 511U << 20U | (512U + 256U) << 10U;
  std::string bytes = head(3, 1, 0) + std::string(9, '\0') + bytes_of({204, 0, 0, 0, 0, 0, 0}) + little(packed);
  const Gaussians g = parse_spz("m.spz", test::gzip(bytes)).gaussians;
  const double y = -256.0 / 511.0 * std::sqrt(0.5);
  EXPECT_NEAR(g.rotations[0], 0.0, 1e-6);
  EXPECT_NEAR(g.rotations[1], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(g.rotations[2], -y, 1e-6);
  EXPECT_NEAR(g.rotations[3], -std::sqrt(0.5 - y * y), 1e-6);
}

TEST(Spz, HarmonicsOfDegree4AreLeftOut) {
  const Gaussians g = parse_spz("m.spz", old_file(2, 4)).gaussians;
  EXPECT_EQ(g.sh_degree, 3);
  EXPECT_EQ(std::abs(g.sh[3]), 0.0F);
  EXPECT_EQ(g.sh[3 + 6], 6.0F / 128.0F);   // of x: the same in both axes
  EXPECT_EQ(g.sh[3 + 3], -3.0F / 128.0F);  // of z: the other way
  EXPECT_EQ(g.sh[47], 44.0F / 128.0F);
}

TEST(Spz, WhatIsWrittenComesBackWithinTheFormatsSteps) {
  for (int degree = 0; degree <= 3; ++degree) {
    const Gaussians g = test::made_gaussians(degree, 300);
    const std::string bytes = spz_bytes("m.spz", g, header);
    EXPECT_TRUE(bytes.starts_with("NGSP" + little<std::uint32_t>(4)));
    const ForeignMap back = parse_spz("m.spz", bytes);
    // Halves of the steps: 2^-12 m; 1/16; 1/255 (opacity), 1/(255 * 0.15), 1/128; 1/(511 sqrt(2)). The largest component
    // of a quaternion is restored from the others, none of which is larger: at most three times as wrong.
    test::expect_near(back.gaussians, g,
                      {0.5 / 4096, 0.5001 / 16, 0.5001 / 255, 0.5001 / (255 * 0.15), 0.5001 / 128,
                       0.5001 / (511 * std::sqrt(2.0)) * 3.0});
    EXPECT_EQ(back.lines, header);
    EXPECT_EQ(spz_lines("m.spz", bytes), header);
    EXPECT_EQ(spz_bytes("m.spz", back.gaussians, header), bytes);  // a second pass changes nothing
  }
}

TEST(Spz, SmallAndLargeMapsKeepTheirPositions) {
  for (const float size : {0.01F, 1.0F, 1e3F, 1e5F, 4e6F}) {
    Gaussians g = test::made_gaussians(0, 50);
    double most = 0.0;
    for (float& p : g.positions) {
      p *= size / 5.0F;
      most = std::max(most, std::abs(double{p}));
    }
    const Gaussians back = parse_spz("m.spz", spz_bytes("m.spz", g, {})).gaussians;
    const double step = std::max(std::min(1.0 / 4096, most / 16384), most / 4194304);
    for (std::size_t at = 0; at < g.positions.size(); ++at) {
      EXPECT_NEAR(back.positions[at], g.positions[at], 0.5001 * step) << size;
    }
  }
  Gaussians far = test::made_gaussians(0, 1);
  far.positions[1] = 5e6F;
  EXPECT_EQ(fault_of([&] { spz_bytes("m.spz", far, {}); }),
            "m.spz: a coordinate is above 4e6 m, which SPZ cannot store");
}

TEST(Spz, ValuesOutOfRangeAreClamped) {
  Gaussians g = test::made_gaussians(1, 1);
  g.log_scales = {-20, 13, 5.9375F};
  g.sh.assign(12, 100.0F);
  g.opacity_logits = {50};
  const Gaussians back = parse_spz("m.spz", spz_bytes("m.spz", g, {})).gaussians;
  EXPECT_THAT(back.log_scales, ElementsAre(-10, 5.9375F, 5.9375F));
  EXPECT_EQ(back.sh[6], 1.0F);             // of z, which is stored as its opposite
  EXPECT_EQ(back.sh[9], 127.0F / 128.0F);  // of x
  EXPECT_NEAR(test::opacity(back, 0), 1.0, 0.5 / 255);
}

TEST(Spz, AntialiasingIsCompensation) {
  EXPECT_THAT(parse_spz("m.spz", old_file(2, 0, 1)).lines, ElementsAre("compensated 1"));
  EXPECT_THAT(parse_spz("m.spz", old_file(2)).lines, ElementsAre());
  const std::string bytes = spz_bytes("m.spz", test::made_gaussians(0, 1), {"compensated 1"});
  EXPECT_EQ(bytes[14], 3);  // antialiased, extensions
  EXPECT_EQ(spz_bytes("m.spz", test::made_gaussians(0, 1), {})[14], 0);
}

TEST(Spz, ExtensionsOfOthersAreSkipped) {
  std::string bytes = spz_bytes("m.spz", test::made_gaussians(0, 2), header);
  const std::string other = little<std::uint32_t>(0xADBE0002) + little<std::uint32_t>(12) + std::string(12, 'x');
  bytes.insert(32, other);
  const auto table = load_little<std::uint32_t>(&bytes[16]) + static_cast<std::uint32_t>(other.size());
  bytes.replace(16, 4, little(table));
  EXPECT_EQ(parse_spz("m.spz", bytes).lines, header);
  bytes.replace(36, 4, little<std::uint32_t>(1U << 31U));
  EXPECT_THAT(fault_of([&] { parse_spz("m.spz", bytes); }), HasSubstr("an extension is longer than the header"));
}

std::string fault(const std::string& bytes) {
  return fault_of([&] { parse_spz("m.spz", bytes); });
}

TEST(Spz, FaultsAreNamed) {
  const std::string good = spz_bytes("m.spz", test::made_gaussians(1, 20), header);
  for (std::size_t n = 4; n < good.size(); ++n) EXPECT_NE(fault(good.substr(0, n)), "") << n;
  const std::string old = old_file(2);
  for (std::size_t n = 2; n < old.size(); ++n) {
    EXPECT_THAT(fault(old.substr(0, n)), HasSubstr("is cut off or damaged: its gzip data")) << n;
  }
  EXPECT_THAT(fault(test::gzip("NGSP")), HasSubstr("m.spz: is cut off"));
  EXPECT_EQ(fault(test::gzip("a text that is no map")), "m.spz: is compressed (gzip), but is no SPZ: unpack it first");
  EXPECT_THAT(fault(test::gzip(head(5, 1, 0))), HasSubstr("is SPZ of version 5, which is not read"));
  EXPECT_THAT(fault(test::gzip(head(2, 1, 5))), HasSubstr("has SH degree 5, must be 0 to 4"));
  EXPECT_THAT(fault(test::gzip(head(2, 1, 0, 24))), HasSubstr("has 24 fractional bits"));
  EXPECT_EQ(fault(test::gzip(head(2, 0, 0))), "m.spz: holds no Gaussians");
  std::string wrong = good;
  wrong[8] = 21;
  EXPECT_THAT(fault(wrong), HasSubstr("stream 0: declares 180 bytes, must have 189 for 21 Gaussians"));
  wrong = good;
  wrong[15] = 4;
  EXPECT_THAT(fault(wrong), HasSubstr("has 4 streams, must have 6"));
  wrong = good;
  wrong[good.size() - 4] ^= 0x55;
  EXPECT_NE(fault(wrong), "");
}

// Refused by their headers: nothing of the size that they declare is allocated.
TEST(Spz, CountsBeyondTheFileAreRefused) {
  EXPECT_THAT(fault(test::gzip(head(2, 4'000'000'000U, 3))), HasSubstr("bytes of data, more than its"));
  std::string bomb = spz_bytes("m.spz", test::made_gaussians(0, 2), {});
  bomb.replace(8, 4, little<std::uint32_t>(4'000'000'000U));
  EXPECT_THAT(fault(bomb), HasSubstr("bytes of data, more than its"));
  // A stream that decompresses to more than the table says.
  std::string longer = spz_bytes("m.spz", test::made_gaussians(0, 2), {});
  const std::string zeros = zstd_compressed(std::string(1 << 20, '\0'));
  const std::size_t first = load_little<std::uint64_t>(&longer[32]);
  longer.replace(32 + 5 * 16, first, zeros);
  longer.replace(32, 8, little<std::uint64_t>(zeros.size()));
  EXPECT_THAT(fault(longer), HasSubstr("stream 0: is damaged: its zstd data are not of the declared size"));
}

TEST(Spz, PositionsThatAreNotFiniteAreBroken) {
  std::string bytes = head(1, 1, 0) + bytes_of({0x00, 0x7C, 0, 0, 0, 0}) + std::string(10, '\x40');
  EXPECT_THAT(fault(test::gzip(bytes)), HasSubstr("Gaussian 0: its position is not finite"));
}

}  // namespace
}  // namespace odosplat
