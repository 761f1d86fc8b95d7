// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

namespace odosplat::apps {

/// Frames of a sequence that cannot be read: one damaged file of many is no reason to do nothing with the others.
class UnreadableFrames {
 public:
  void add(const std::string& fault) {
    if (count_++ == 0) first_fault_ = fault;
  }
  std::size_t count() const { return count_; }

  /// At the end: nothing if there are none, InputError if all `frames` are such, else one warning that they are left
  /// out.
  void report(std::size_t frames) const;

 private:
  std::size_t count_ = 0;
  std::string first_fault_;
};

}  // namespace odosplat::apps
