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

class Sizes : public testing::TestWithParam<std::tuple<int, Layout>> {
 protected:
  std::size_t n_ = static_cast<std::size_t>(std::get<0>(GetParam()));
  Layout layout_ = std::get<1>(GetParam());
  Context context_ = Context::open();
};

TEST_P(Sizes, ScanEqualsSerialSum) {
  Random random(1);
  std::vector<std::uint32_t> counts(n_);
  for (auto& c : counts) c = random.below(1000);
  Buffer<std::uint32_t> out;
  Scan(context_, layout_).exclusive(Buffer<std::uint32_t>(context_, counts), n_, out);
  std::vector<std::uint32_t> expected(n_ + 1, 0);
  for (std::size_t i = 0; i < n_; ++i) expected[i + 1] = expected[i] + counts[i];
  EXPECT_EQ(out.download(), expected);
}

TEST_P(Sizes, SortEqualsStableSort) {
  Random random(2);
  std::vector<std::uint32_t> keys(n_);
  // Bits of depths, many of them equal; some keys have the largest value (culled).
  for (auto& k : keys) {
    const float depth = 0.1F + 0.01F * static_cast<float>(random.below(700));
    k = random.below(10) == 0 ? 0xffffffffU : std::bit_cast<std::uint32_t>(depth);
  }
  Buffer<std::uint32_t> order;
  RadixSort(context_, layout_).sort(Buffer<std::uint32_t>(context_, keys), n_, order);
  std::vector<std::uint32_t> expected(n_);
  std::iota(expected.begin(), expected.end(), 0U);
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  EXPECT_EQ(order.download(), expected);
}

// Sorts with passes of 11 and of 4 bits: odd and even numbers of passes, and unused bits in the last digit.
TEST_P(Sizes, SortOfShortKeysEqualsStableSort) {
  for (const int bits : {1, 4, 5, 11, 12, 17}) {
    Random random(3);
    std::vector<std::uint32_t> keys(n_);
    for (auto& k : keys) k = random.below(1U << static_cast<unsigned>(bits));
    Buffer<std::uint32_t> order;
    RadixSort(context_, layout_).sort(Buffer<std::uint32_t>(context_, keys), n_, order, bits);
    std::vector<std::uint32_t> expected(n_);
    std::iota(expected.begin(), expected.end(), 0U);
    std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
    EXPECT_EQ(order.download(), expected) << bits << " bits";
  }
}

TEST_P(Sizes, BuffersMayBeUsedAgain) {
  Scan scan(context_, layout_);
  RadixSort sort(context_, layout_);
  Buffer<std::uint32_t> sums, order;
  for (const std::size_t n : {n_, n_ / 2, n_ + 1}) {
    std::vector<std::uint32_t> keys(n), expected(n);
    for (std::size_t i = 0; i < n; ++i) {
      keys[i] = static_cast<std::uint32_t>(n - i);
      expected[i] = static_cast<std::uint32_t>(n - 1 - i);
    }
    const Buffer<std::uint32_t> buffer(context_, keys);
    scan.exclusive(buffer, n, sums);
    const std::vector<std::uint32_t> found = sums.download();
    EXPECT_EQ(found.back(), std::accumulate(keys.begin(), keys.end(), 0U));
    sort.sort(buffer, n, order);
    EXPECT_EQ(order.download(), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(AroundGroupAndChunk, Sizes,
                         testing::Combine(testing::Values(0, 1, 2, 63, 64, 65, 255, 257, 1023, 1025, 2047, 2049, 4095,
                                                          4096, 4097, 100003, 300000),
                                          testing::Values(Layout::chunks, Layout::groups)));

}  // namespace
}  // namespace odosplat::compute
