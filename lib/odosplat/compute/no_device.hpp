// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::compute {

/// Why there is no OpenCL device, as far as can be told, in words for one line: PoCL has a cache folder that it cannot
/// write, memory is limited, or no runtime is installed.
std::string no_device_reason();

}  // namespace odosplat::compute
