// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/convention_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace odosplat {
namespace {

using testing::HasSubstr;
using testing::Not;

ConventionRow row(int shift, double scale, double error) {
  ConventionRow r;
  r.convention = {1, false, shift, scale};
  r.relative_error = error;
  r.tried = true;
  r.pair_errors.assign(10, error);
  return r;
}

// Few images: another shift with the declared scale fits as well as another scale with the declared shift, so neither
// is reported as wrong.
TEST(JudgeConventions, DeniesNoPartThatAnotherOneMayExplain) {
  const Camera camera{160, 120, 130.0, 128.0, 79.0, 60.5};
  ConventionReport report;
  report.declared = {1, false, 0, 1000.0};
  report.rows = {row(-1, 1000.0, 0.0050), row(0, 5000.0, 0.0051), row(0, 1000.0, 0.0109)};
  judge_conventions(report, camera, 0.05);
  EXPECT_FALSE(report.as_declared);
  EXPECT_THAT(report.verdict, HasSubstr("the data do not agree with what is declared"));
  EXPECT_THAT(report.verdict, Not(HasSubstr("not 0 as the file says")));
  EXPECT_THAT(report.verdict, HasSubstr("0 with depth scale 5000"));
  // If no other scale fits, the shift is reported as wrong.
  report = {};
  report.declared = {1, false, 0, 1000.0};
  report.rows = {row(-1, 1000.0, 0.0050), row(1, 1000.0, 0.0051), row(0, 1000.0, 0.0109)};
  judge_conventions(report, camera, 0.05);
  EXPECT_THAT(report.verdict, HasSubstr("not 0 as the file says"));
}

TEST(JudgeConventions, NamesTheFactorOfTheDepths) {
  const Camera camera{160, 120, 130.0, 128.0, 79.0, 60.5};
  ConventionReport report;
  report.declared = {1, false, 0, 1000.0};
  report.rows = {row(0, 5000.0, 0.001), row(-1, 5000.0, 0.02), row(0, 1000.0, 0.2)};
  judge_conventions(report, camera, 0.05);
  EXPECT_THAT(report.verdict, HasSubstr("the data want 5000, the file says 1000 (depths are read 5 times too large)"));
}

}  // namespace
}  // namespace odosplat
