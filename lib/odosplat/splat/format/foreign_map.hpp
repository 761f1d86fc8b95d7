// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// What a file of another format than PLY holds.
struct ForeignMap {
  /// In the axes of a 3DGS PLY.
  Gaussians gaussians;
  /// The lines of a map's header (MapHeader) if the file carries them, with "odosplat map, format 1"; else what the
  /// format itself says, as such lines ("compensated 1").
  std::vector<std::string> lines;
};

/// The content of a file beside the one that is read, by the name that it gives ("means_l.webp"); InputError if it
/// cannot be read.
using ReadSibling = std::function<std::string(const std::string& name)>;

/// Lines as one text, each with a line end, and back. Empty lines are left out.
std::string joined_lines(const std::vector<std::string>& lines);
std::vector<std::string> split_lines(const std::string& text);

}  // namespace odosplat
