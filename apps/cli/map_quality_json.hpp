// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <nlohmann/json.hpp>

#include "odosplat/splat/quality/map_quality.hpp"

namespace odosplat::apps {

/// What a map is worth, as reports have it: unknown values are null.
nlohmann::ordered_json json_of(const MapQuality& quality);

}  // namespace odosplat::apps
