// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// Gaussians of a file that hold a value which is none, or which no device can draw (undrawable_value), as programs
/// leave them behind where training diverged: a few are left out, many make the file worthless.
class BrokenRows {
 public:
  /// `name` stands for the file in messages, `count` is its number of Gaussians.
  BrokenRows(std::string name, std::size_t count) : name_(std::move(name)), is_broken_(count) {}

  /// Says what is wrong with Gaussian i, from 0; the first fault said is the one that is shown.
  void add(std::size_t i, const std::string& fault);

  /// Adds those that cannot be drawn, and takes all out of `gaussians`, which has all rows, with one warning.
  /// InputError(file, "Gaussian N", fault) if they are more than a tenth.
  void leave_out(Gaussians& gaussians);

 private:
  std::string name_;
  std::vector<bool> is_broken_;
  std::size_t broken_ = 0;
  std::string first_place_;
  std::string first_fault_;
};

}  // namespace odosplat
