// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>

#include "odosplat/splat/quality/map_quality.hpp"

namespace odosplat::apps {

/// A map's quality as JSON for reports: unknown values are null.
nlohmann::ordered_json json_of(const MapQuality& quality);

}  // namespace odosplat::apps
