// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::compute {

/// The probable reason why there is no OpenCL device, as part of a one-line message: PoCL cannot write its cache
/// folder, memory is limited (ulimit -v), or no runtime is installed.
std::string no_device_reason();

}  // namespace odosplat::compute
