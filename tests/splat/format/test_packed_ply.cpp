// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/packed_ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/splat/format/made_map.hpp"

namespace odosplat {
namespace {

using test::fault_of;
using testing::HasSubstr;

/// `count` Gaussians: i of them in the words, all chunks between 0 and 1, -4 and -2 (sizes), and -1 and 1 (colours).
Ply packed(std::size_t count, int degree, bool color_range = true) {
  Ply ply;
  ply.file = "m.ply";
  const std::size_t chunks = (count + 255) / 256;
  PlyElement chunk;
  chunk.name = "chunk";
  const auto add_range = [&](const std::string& name, float least, float most) {
    chunk.add("min_" + name, std::vector<float>(chunks, least));
    chunk.add("max_" + name, std::vector<float>(chunks, most));
  };
  for (const char* axis : {"x", "y", "z"}) add_range(axis, 0.0F, 1.0F);
  for (const char* axis : {"scale_x", "scale_y", "scale_z"}) add_range(axis, -4.0F, -2.0F);
  if (color_range) {
    for (const char* channel : {"r", "g", "b"}) add_range(channel, -1.0F, 1.0F);
  }
  PlyElement vertex;
  vertex.name = "vertex";
  const auto word = [&](std::uint32_t value) { return std::vector<std::uint32_t>(count, value); };
  vertex.add("packed_position", word(2047U << 21U | 0U << 11U | 1023U));
  vertex.add("packed_rotation", word(1U << 30U | 1023U << 20U | 0U << 10U | 256U));
  vertex.add("packed_scale", word(0U << 21U | 1023U << 11U | 2047U));
  vertex.add("packed_color", word(255U << 24U | 0U << 16U | 51U << 8U | 204U));
  ply.elements = {chunk, vertex};
  if (degree > 0) {
    PlyElement sh;
    sh.name = "sh";
    for (int j = 0; j < 3 * (sh_coefficients(degree) - 1); ++j) {
      sh.add("f_rest_" + std::to_string(j), std::vector<std::uint8_t>(count, static_cast<std::uint8_t>(5 * j)));
    }
    ply.elements.push_back(sh);
  }
  return ply;
}

TEST(PackedPly, IsReadAsItsBitsSay) {
  for (const std::size_t count : {1U, 256U, 257U}) {
    const Ply ply = packed(count, 0);
    ASSERT_TRUE(is_packed_ply(ply));
    const Gaussians g = gaussians_from_packed_ply(ply);
    ASSERT_EQ(g.size(), count);
    const std::size_t i = count - 1;
    EXPECT_EQ(g.positions[3 * i], 1.0F);
    EXPECT_EQ(g.positions[3 * i + 1], 0.0F);
    EXPECT_NEAR(g.positions[3 * i + 2], 1023.0 / 2047.0, 1e-6);
    EXPECT_EQ(g.log_scales[3 * i], -4.0F);
    EXPECT_EQ(g.log_scales[3 * i + 1], -2.0F);
    // w and y, z around x, the largest: 1023 and 0 are 1/sqrt(2) and -1/sqrt(2).
    EXPECT_NEAR(g.rotations[4 * i], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(g.rotations[4 * i + 2], -std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(g.rotations[4 * i + 3], (512.0 / 1023.0 - 1.0) * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(g.sh[3 * i], 0.5 / 0.28209479, 1e-5);                    // 255: the upper end, 1
    EXPECT_NEAR(g.sh[3 * i + 1], -1.5 / 0.28209479, 1e-5);               // 0: the lower end, -1
    EXPECT_NEAR(g.sh[3 * i + 2], (0.4 - 1.0 - 0.5) / 0.28209479, 1e-5);  // a fifth of -1..1
    EXPECT_NEAR(test::opacity(g, i), 0.8, 1e-6);
  }
  EXPECT_NEAR(gaussians_from_packed_ply(packed(1, 0, false)).sh[2], (0.2 - 0.5) / 0.28209479, 1e-5);
}

TEST(PackedPly, HarmonicsAreChannelAfterChannel) {
  for (int degree = 1; degree <= 3; ++degree) {
    const Gaussians g = gaussians_from_packed_ply(packed(3, degree));
    ASSERT_EQ(g.sh_degree, degree);
    const auto k = static_cast<std::size_t>(g.coefficients());
    for (std::size_t j = 1; j < k; ++j) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t byte = 5 * (c * (k - 1) + j - 1);
        const double value = byte == 0 ? -4.0 : (static_cast<double>(byte) + 0.5) / 32.0 - 4.0;
        EXPECT_NEAR(g.sh[3 * (2 * k + j) + c], value, 1e-6) << degree << " " << j << " " << c;
      }
    }
  }
}

TEST(PackedPly, FaultsAreNamed) {
  const auto with = [](const auto& change) {
    Ply ply = packed(300, 1);
    change(ply);
    return fault_of([&] { gaussians_from_packed_ply(ply); });
  };
  EXPECT_EQ(with([](Ply&) {}), "");
  EXPECT_THAT(with([](Ply& p) { p.elements.erase(p.elements.begin()); }), HasSubstr("m.ply: "));
  EXPECT_THAT(with([](Ply& p) { p.elements[0] = packed(1, 0).elements[0]; }),
              HasSubstr("chunk: has 1 rows, must have one for 256 of the 300 Gaussians each"));
  EXPECT_THAT(with([](Ply& p) { p.elements[1].properties.pop_back(); }), HasSubstr("packed_color"));
  EXPECT_THAT(with([](Ply& p) { p.elements[2].properties.pop_back(); }), HasSubstr("must have 9, 24 or 45"));
  EXPECT_THAT(with([](Ply& p) { p.elements[2] = packed(299, 1).elements[2]; }),
              HasSubstr("has 299 rows, must have 300"));
  EXPECT_THAT(with([](Ply& p) {
                p.elements[0].properties[0].values = std::vector<float>(2, std::numeric_limits<float>::quiet_NaN());
              }),
              HasSubstr("Gaussian 0: its position is not finite; 300 of 300 Gaussians are broken"));
  EXPECT_THAT(fault_of([] { gaussians_from_packed_ply(packed(0, 0)); }), HasSubstr("m.ply: holds no Gaussians"));
}

}  // namespace
}  // namespace odosplat
