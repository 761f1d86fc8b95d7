// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <stdexcept>

namespace odosplat::apps {

/// The run was carried out, but its result is not usable: less than half of an estimate was matched, no frame got a
/// pose, or a check found that the data disagree or could not decide. The program prints the reason in one line and exits
/// with status 3.
class NoResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace odosplat::apps
