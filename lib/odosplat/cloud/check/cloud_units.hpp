// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>

#include "odosplat/cloud/check/cloud_material.hpp"

namespace odosplat {

/// A factor of the cloud's coordinates, of those that units of length make, with which the cloud fits better than as
/// given and better than both controls do; the best one, none if no factor is. Tried with what is declared and with the
/// report's winner.
std::optional<double> likely_unit(CloudMaterial& material, const CloudCheckReport& report,
                                  const CloudCheckOptions& options);

}  // namespace odosplat
