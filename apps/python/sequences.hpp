// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::python {

/// A sequence and what it was opened from, to open it in another way too.
struct HeldSequence {
  Sequence sequence;
  std::string path;
  SequenceOptions options;
};

/// A list of Python's sequences (HeldSequence each). InputError(name, ...) for an empty one.
std::vector<Sequence> sequences_from(const pybind11::list& list, const std::string& name);

}  // namespace odosplat::python
