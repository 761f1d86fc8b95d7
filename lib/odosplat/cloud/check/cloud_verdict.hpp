// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// Sets the winner of a report, and whether it is believable. The rows must have been measured and sorted, and the
/// declared reading must be among them.
void choose_reading(CloudCheckReport& report, double max_error);

/// Sets findings, answer and verdict, including the findings of the fit if there is one.
void judge_cloud(CloudCheckReport& report, const CloudCheckOptions& options, const Camera& camera);

}  // namespace odosplat
