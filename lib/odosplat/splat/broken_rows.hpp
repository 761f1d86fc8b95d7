// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// Gaussians of a file with an invalid value, or one that no device can draw (undrawable_value), such as programs write
/// after training has diverged: a few are left out, many make the file invalid.
class BrokenRows {
 public:
  /// `name` stands for the file in messages, `count` is its number of Gaussians.
  BrokenRows(std::string name, std::size_t count) : name_(std::move(name)), is_broken_(count) {}

  /// Marks Gaussian i, from 0, as broken; messages show the first fault that was added.
  void add(std::size_t i, const std::string& fault);

  /// Marks those that cannot be drawn, too, and removes all marked ones from `gaussians`, which has all rows, with one
  /// warning. InputError(file, "Gaussian N", fault) if they are more than a tenth.
  void leave_out(Gaussians& gaussians);

 private:
  std::string name_;
  std::vector<bool> is_broken_;
  std::size_t broken_ = 0;
  std::string first_place_;
  std::string first_fault_;
};

}  // namespace odosplat
