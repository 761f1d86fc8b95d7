// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/method.hpp"

#include <gtest/gtest.h>

namespace odosplat::apps_test {
namespace {

TEST(Method, OnlyOurOwnAsksTheMap) {
  for (const apps::MethodPreset& preset : apps::method_presets()) {
    for (const std::optional<bool> anchor : {std::optional<bool>(), std::optional(true), std::optional(false)}) {
      EXPECT_EQ(apps::odometry_options(preset, anchor).confirmation.enabled, std::string(preset.name) == "gaussian")
          << preset.name;
    }
  }
}

}  // namespace
}  // namespace odosplat::apps_test
