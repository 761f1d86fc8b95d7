// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <vector>

#include "tests/house/repository.hpp"

namespace {

using namespace odosplat::test::house;

std::vector<fs::path> documents() {
  std::vector<fs::path> found{root / "README.md", root / "CONTRIBUTING.md", root / "data/README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) found.push_back(entry.path());
  return found;
}

// All paths in the documents, in `code` or as [link](target), must exist.
TEST(Documents, NameWhatExists) {
  static const std::regex path(R"re([`(]((?:lib|kernels|apps|viewer|tests|data|docs)/[\w./-]*)[`)])re");
  int named = 0;
  std::vector<fs::path> all = documents();
  all.push_back(root / "CHANGELOG.md");
  for (const fs::path& document : all) {
    const std::string text = text_of(document);
    for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it, ++named) {
      const std::string name = (*it)[1];
      EXPECT_TRUE(fs::exists(root / name)) << document << " names " << name;
    }
  }
  EXPECT_GT(named, 30);
}

// Source files in the documents are named by their path from the repository or as an include, or by a name that only one
// file has. NAME stands for a file that does not exist yet.
TEST(Documents, NameSourcesWithoutDoubt) {
  std::map<std::string, int> files;
  for (const char* folder : {"lib", "kernels", "apps", "viewer", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) ++files[entry.path().filename().string()];
  }
  static const std::regex source(R"re([`<]([\w./-]+\.(?:cpp|hpp|cl))[`>])re");
  int named = 0;
  for (const fs::path& document : documents()) {
    const std::string text = text_of(document);
    for (std::sregex_iterator it(text.begin(), text.end(), source), end; it != end; ++it, ++named) {
      const std::string name = (*it)[1];
      if (name.find("NAME") != std::string::npos) continue;
      const bool is_path = name.find('/') != std::string::npos;
      EXPECT_TRUE(is_path ? !file_of(name).empty() : files[name] == 1) << document << " names " << name;
    }
  }
  EXPECT_GT(named, 40);
}

// The README must be short; details are in docs.
TEST(Documents, TheReadmeIsShort) {
  const std::string text = text_of(root / "README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 120);
}

}  // namespace
