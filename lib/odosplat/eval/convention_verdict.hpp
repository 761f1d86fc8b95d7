// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"
#include "odosplat/eval/convention_report.hpp"

namespace odosplat {

/// Sets winner, findings and verdict of a report. Its rows must have been measured and sorted, and the declared
/// convention must be among them.
void judge_conventions(ConventionReport& report, const Camera& camera, double max_error);

}  // namespace odosplat
