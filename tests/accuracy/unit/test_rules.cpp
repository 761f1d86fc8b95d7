// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <set>

#include "tests/accuracy/rules.hpp"

namespace odosplat::accuracy {
namespace {

TEST(Rules, SwitchedOffGiveOptionsThatTheOdometryTakes) {
  EXPECT_GE(rules().size(), 24U);
  std::set<std::string> names;
  for (const Rule& rule : rules()) {
    SCOPED_TRACE(rule.name);
    EXPECT_TRUE(names.insert(rule.name).second);
    OdometryOptions options;
    rule.off(options);
    EXPECT_NO_THROW(options.check());
    EXPECT_GT(rule.gain, 0.9);
    EXPECT_LE(rule.gain, 1.0);
  }
}

}  // namespace
}  // namespace odosplat::accuracy
