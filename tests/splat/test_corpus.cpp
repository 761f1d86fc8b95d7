// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Replays the seeds and kept findings of the fuzzer of Gaussian files: a violated contract aborts this program.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "odosplat/io/atomic_file.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/locations.hpp"

namespace odosplat {
namespace {

TEST(GaussianCorpus, EverySeedAndEveryCutOfItIsReadOrRefused) {
  int seeds = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::source_dir() + "/tests/fuzz/corpus/gaussians")) {
    const std::string bytes = read_file(file.path().string());
    SCOPED_TRACE(file.path().string());
    fuzz::gaussians(bytes);
    for (std::size_t k = 0; k < 32; ++k) fuzz::gaussians(bytes.substr(0, bytes.size() * k / 32));
    ++seeds;
  }
  EXPECT_GT(seeds, 3);
}

}  // namespace
}  // namespace odosplat
