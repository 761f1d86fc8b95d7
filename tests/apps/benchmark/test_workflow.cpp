// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The workflow runs its commands in a shell: values from outside must be quoted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/apps/run_program.hpp"
#include "tests/locations.hpp"

namespace odosplat::apps_test {
namespace {

std::vector<std::string> shell_commands(const std::string& text) {
  static const std::regex command(R"re(shell:\s*"([^"]*)")re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), command), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

TEST(Workflow, QuotesAllThatCommandsAreMadeOf) {
  const std::string text = read_text(test::source_dir() + "/apps/benchmark/workflow/Snakefile");
  const std::vector<std::string> commands = shell_commands(text);
  ASSERT_EQ(commands.size(), 2U);
  static const std::regex field(R"re(\{([^}]*)\})re");
  int fields = 0;
  for (const std::string& command : commands) {
    for (std::sregex_iterator it(command.begin(), command.end(), field), end; it != end; ++it, ++fields) {
      const std::string name = (*it)[1];
      EXPECT_TRUE(name == "threads" || (name.size() > 2 && name.substr(name.size() - 2) == ":q"))
          << "{" << name << "} in: " << command;
    }
  }
  EXPECT_GE(fields, 6);
}

TEST(Workflow, ChecksTheIdsOfThePlan) {
  const std::string text = read_text(test::source_dir() + "/apps/benchmark/workflow/Snakefile");
  EXPECT_THAT(text, testing::HasSubstr(R"re(re.fullmatch(r"[A-Za-z0-9._-]+", word))re"));
  EXPECT_THAT(text, testing::HasSubstr("re.escape(job)"));
}

}  // namespace
}  // namespace odosplat::apps_test
