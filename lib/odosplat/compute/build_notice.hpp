// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>

#include "odosplat/compute/context.hpp"

namespace odosplat::compute {

/// Sets a callback that tells a waiting user why a program takes long to start: `notice` is called once, in a thread of
/// its own, when building programs on this context (not loading them from the cache) has taken after_s seconds in
/// total. By default there is none.
void set_build_notice(const Context& context, std::function<void()> notice, double after_s = 1.0);

}  // namespace odosplat::compute
