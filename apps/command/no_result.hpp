// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <stdexcept>

namespace odosplat::apps {

/// The run did what was asked and its result is worth nothing: under half of an estimate was matched, no frame was
/// posed, or checked data are not shown to agree. The program says the reason in one line and ends with 3.
class NoResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace odosplat::apps
