// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Replays the seeds and kept findings of the fuzzers: a violated contract aborts this program.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/locations.hpp"

namespace odosplat {
namespace {

struct Target {
  const char* name;
  void (*entry)(const std::string& bytes);
};

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

class Corpus : public testing::TestWithParam<Target> {
 protected:
  void TearDown() override { set_log_level("info"); }
};

TEST_P(Corpus, EverySeedAndEveryCutOfItIsReadOrRefused) {
  int seeds = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(test::source_dir() + "/tests/fuzz/corpus/" + GetParam().name)) {
    const std::string bytes = read_file(file.path().string());
    SCOPED_TRACE(file.path().string());
    GetParam().entry(bytes);
    for (std::size_t k = 0; k < 32; ++k) GetParam().entry(bytes.substr(0, bytes.size() * k / 32));
    ++seeds;
  }
  EXPECT_GT(seeds, 3);
}

INSTANTIATE_TEST_SUITE_P(
    All, Corpus,
    testing::Values(Target{"image", fuzz::image}, Target{"ply", fuzz::ply}, Target{"trajectory", fuzz::trajectory},
                    Target{"camera_file", fuzz::camera_file}, Target{"sequence_lists", fuzz::sequence_lists},
                    Target{"colmap_text", fuzz::colmap_text}, Target{"colmap_binary", fuzz::colmap_binary},
                    Target{"transforms", fuzz::transforms}, Target{"pcd", fuzz::pcd}, Target{"las", fuzz::las},
                    Target{"cloud_text", fuzz::cloud_text}));

}  // namespace
}  // namespace odosplat
