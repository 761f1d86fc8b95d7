// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/packed_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "odosplat/io/little_endian.hpp"

namespace odosplat::apps {
namespace {

Gaussians random_gaussians(std::size_t count, int degree) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  Gaussians gaussians;
  gaussians.sh_degree = degree;
  gaussians.resize(count);
  for (float& value : gaussians.positions) value = 3.0F * normal(random);
  for (float& value : gaussians.log_scales) value = -4.0F + normal(random);
  for (float& value : gaussians.rotations) value = 2.0F * normal(random);
  for (float& value : gaussians.opacity_logits) value = normal(random);
  for (float& value : gaussians.sh) value = normal(random);
  return gaussians;
}

std::vector<std::size_t> all_rows(const Gaussians& gaussians) {
  std::vector<std::size_t> rows(gaussians.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// The reader of the format as its description has it, as packed_map.js does it.
class Unpacked {
 public:
  explicit Unpacked(const PackedMap& map)
      : map_(map), channels_(6 + 3 * static_cast<std::size_t>(sh_coefficients(map.sh_degree))) {
    const std::size_t chunks = (map.count + PackedMap::chunk - 1) / PackedMap::chunk;
    rotations_ = 8 * chunks * channels_;
    places_ = rotations_ + 4 * map.count;
    bytes_ = places_ + 6 * map.count;
  }
  std::size_t size() const { return bytes_ + (channels_ - 3 + 1) * map_.count; }
  float value(std::size_t i, std::size_t channel) const {
    const std::size_t range = 8 * (i / PackedMap::chunk * channels_ + channel);
    const auto low = load_little<float>(map_.bytes.data() + range);
    const auto high = load_little<float>(map_.bytes.data() + range + 4);
    const float share = channel < 3 ? static_cast<float>(load_little<std::uint16_t>(map_.bytes.data() + places_ +
                                                                                    2 * (channel * map_.count + i))) /
                                          65535.0F
                                    : static_cast<float>(byte(bytes_ + (channel - 3) * map_.count + i)) / 255.0F;
    return low + (high - low) * share;
  }
  float opacity(std::size_t i) const {
    return static_cast<float>(byte(bytes_ + (channels_ - 3) * map_.count + i)) / 255.0F;
  }
  Eigen::Quaternionf rotation(std::size_t i) const {
    const auto bits = load_little<std::uint32_t>(map_.bytes.data() + rotations_ + 4 * i);
    Eigen::Vector4f wxyz = Eigen::Vector4f::Zero();
    const auto largest = static_cast<Eigen::Index>(bits >> 30U);
    unsigned shift = 0;
    for (Eigen::Index k = 0; k < 4; ++k) {
      if (k == largest) continue;
      wxyz[k] = (static_cast<float>(bits >> shift & 1023U) / 1023.0F * 2.0F - 1.0F) * std::sqrt(0.5F);
      shift += 10U;
    }
    wxyz[largest] = std::sqrt(std::max(0.0F, 1.0F - wxyz.squaredNorm()));
    return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
  }

 private:
  unsigned char byte(std::size_t at) const { return static_cast<unsigned char>(map_.bytes[at]); }

  const PackedMap& map_;
  std::size_t channels_, rotations_ = 0, places_ = 0, bytes_ = 0;
};

/// For each packed Gaussian the nearest one of the map.
std::vector<std::size_t> sources(const Gaussians& gaussians, const Unpacked& unpacked) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    std::size_t best = 0;
    float least = 1e9F;
    for (std::size_t k = 0; k < gaussians.size(); ++k) {
      float distance = 0.0F;
      for (std::size_t c = 0; c < 3; ++c) distance += std::abs(unpacked.value(i, c) - gaussians.positions[3 * k + c]);
      if (distance < least) {
        least = distance;
        best = k;
      }
    }
    EXPECT_LT(least, 1e-3F);
    found.push_back(best);
  }
  return found;
}

TEST(PackedMap, GivesBackWhatWasPacked) {
  const Gaussians gaussians = random_gaussians(600, 1);
  const PackedMap packed = pack_map(gaussians, all_rows(gaussians), 3);
  EXPECT_EQ(packed.count, 600U);
  EXPECT_EQ(packed.sh_degree, 1);
  const Unpacked unpacked(packed);
  ASSERT_EQ(packed.bytes.size(), unpacked.size());
  const std::vector<std::size_t> source = sources(gaussians, unpacked);
  std::vector<std::size_t> sorted = source;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, all_rows(gaussians)) << "each once";
  for (std::size_t i = 0; i < source.size(); ++i) {
    const std::size_t k = source[i];
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(unpacked.value(i, 3 + c), gaussians.log_scales[3 * k + c], 0.02F);
    for (std::size_t c = 0; c < 12; ++c) EXPECT_NEAR(unpacked.value(i, 6 + c), gaussians.sh[12 * k + c], 0.02F);
    EXPECT_NEAR(unpacked.opacity(i), 1.0F / (1.0F + std::exp(-gaussians.opacity_logits[k])), 0.003F);
    const float* q = &gaussians.rotations[4 * k];
    const Eigen::Quaternionf rotation = Eigen::Quaternionf(q[0], q[1], q[2], q[3]).normalized();
    EXPECT_LT(rotation.angularDistance(unpacked.rotation(i)), 0.005F);
  }
}

TEST(PackedMap, TakesTheRowsAndTheDegreeThatAreAskedFor) {
  const Gaussians gaussians = random_gaussians(10, 2);
  const PackedMap packed = pack_map(gaussians, {3, 7}, 0);
  EXPECT_EQ(packed.count, 2U);
  EXPECT_EQ(packed.sh_degree, 0);
  const Unpacked unpacked(packed);
  ASSERT_EQ(packed.bytes.size(), unpacked.size());
  const std::vector<float> x{unpacked.value(0, 0), unpacked.value(1, 0)};
  EXPECT_THAT(x, testing::UnorderedElementsAre(testing::FloatNear(gaussians.positions[9], 1e-3F),
                                               testing::FloatNear(gaussians.positions[21], 1e-3F)));
  EXPECT_TRUE(pack_map(gaussians, {}, 0).bytes.empty());
}

TEST(PackedMap, AFarOneDoesNotCoarsenTheOthers) {
  Gaussians gaussians = random_gaussians(1024, 0);
  for (float& value : gaussians.positions) value *= 0.3F;
  gaussians.positions[0] = 9000.0F;
  const PackedMap packed = pack_map(gaussians, all_rows(gaussians), 0);
  const Unpacked unpacked(packed);
  // Chunks of 256 hold what lies together: without the far one each of the four takes about a quarter of the room, in any
  // other order all of it.
  const auto volume = [&](std::size_t begin, std::size_t end) {
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float least = 1e9F;
      float most = -1e9F;
      for (std::size_t i = begin; i < end; ++i) {
        const float value = unpacked.value(i, axis);
        if (value > 1000.0F) continue;
        least = std::min(least, value);
        most = std::max(most, value);
      }
      product *= static_cast<double>(most - least);
    }
    return product;
  };
  int apart = 0;
  for (std::size_t begin = 0; begin < 1024; begin += 256) apart += volume(begin, begin + 256) < 0.6 * volume(0, 1024);
  EXPECT_GE(apart, 3);  // the far one's own chunk may be coarse
}

}  // namespace
}  // namespace odosplat::apps
