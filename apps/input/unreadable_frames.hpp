// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

namespace odosplat::apps {

/// Collects frames of a sequence that cannot be read, so that one damaged file does not prevent the use of the others.
class UnreadableFrames {
 public:
  void add(const std::string& fault) {
    if (count_++ == 0) first_fault_ = fault;
  }
  std::size_t count() const { return count_; }

  /// To be called at the end. Does nothing if all frames are readable; InputError if none of `frames` is; otherwise one
  /// warning that the unreadable ones are left out.
  void report(std::size_t frames) const;

 private:
  std::size_t count_ = 0;
  std::string first_fault_;
};

}  // namespace odosplat::apps
