// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>

#include "odosplat/cloud/check/cloud_material.hpp"

namespace odosplat {

/// The factor for the cloud's coordinates, among those of length_units, with which the cloud fits best, and better than
/// as given and than both controls; none if there is no such factor. Tried with the declared reading and with the
/// report's winner.
std::optional<double> likely_unit(CloudMaterial& material, const CloudCheckReport& report,
                                  const CloudCheckOptions& options);

}  // namespace odosplat
