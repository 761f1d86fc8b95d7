// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "odosplat/io/cloud/ply.hpp"

namespace odosplat {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

/// Index of a type's vector in PlyColumn.
using PlyType = std::size_t;

/// Bytes of a value.
std::size_t ply_size(PlyType type);
/// Name as our writer spells it ("float", "uchar").
const char* ply_type_name(PlyType type);
/// A column of that type without rows.
PlyColumn make_ply_column(PlyType type);

struct PlyHeaderProperty {
  std::string name;
  PlyType type = 0;
  bool is_list = false;
  PlyType length_type = 0;  // of a list's length
};

struct PlyHeaderElement {
  std::string name;
  std::uint64_t rows = 0;  // as promised
  std::vector<PlyHeaderProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<std::string> comments;
  std::vector<PlyHeaderElement> elements;
  std::size_t lines = 0;
};

/// Reads up to and with "end_header". `name` stands for the file in errors. InputError for anything not understood.
PlyHeader read_ply_header(const std::string& name, std::istream& in);

}  // namespace odosplat
