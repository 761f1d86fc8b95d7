// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/cloud/check/cloud_report.hpp"

namespace odosplat {

/// Fills the winner of a report whose rows are measured and sorted and whose declared reading is among them, and
/// whether it is believable.
void choose_reading(CloudCheckReport& report, double max_error);

/// Fills findings and verdict, the fit's included if there is one.
void judge_cloud(CloudCheckReport& report, const CloudCheckOptions& options, const Camera& camera);

}  // namespace odosplat
