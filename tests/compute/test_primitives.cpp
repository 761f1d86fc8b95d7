// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "odosplat/compute/radix_sort.hpp"
#include "odosplat/compute/scan.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat::compute {
namespace {

class Sizes : public testing::TestWithParam<int> {
 protected:
  std::size_t n_ = static_cast<std::size_t>(GetParam());
  Context context_ = Context::open();
};

TEST_P(Sizes, ScanEqualsSerialSum) {
  Random random(1);
  std::vector<std::uint32_t> counts(n_);
  for (auto& c : counts) c = random.below(1000);
  Buffer<std::uint32_t> out;
  Scan(context_).exclusive(Buffer<std::uint32_t>(context_, counts), n_, out);
  std::vector<std::uint32_t> expected(n_ + 1, 0);
  for (std::size_t i = 0; i < n_; ++i) expected[i + 1] = expected[i] + counts[i];
  EXPECT_EQ(out.download(), expected);
}

TEST_P(Sizes, SortEqualsStableSort) {
  Random random(2);
  std::vector<std::uint32_t> keys(n_);
  // Depths as bits, many of them equal, with the largest key (culled) among them.
  for (auto& k : keys) {
    const float depth = 0.1F + 0.01F * static_cast<float>(random.below(700));
    k = random.below(10) == 0 ? 0xffffffffU : std::bit_cast<std::uint32_t>(depth);
  }
  Buffer<std::uint32_t> order;
  RadixSort(context_).sort(Buffer<std::uint32_t>(context_, keys), n_, order);
  std::vector<std::uint32_t> expected(n_);
  std::iota(expected.begin(), expected.end(), 0U);
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  EXPECT_EQ(order.download(), expected);
}

INSTANTIATE_TEST_SUITE_P(AroundGroupAndChunk, Sizes,
                         testing::Values(0, 1, 2, 63, 64, 65, 255, 257, 4095, 4096, 4097, 100003));

}  // namespace
}  // namespace odosplat::compute
