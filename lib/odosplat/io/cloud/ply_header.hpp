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

/// Size of a value [bytes].
std::size_t ply_size(PlyType type);
/// Name of the type as write_ply writes it ("float", "uchar").
const char* ply_type_name(PlyType type);
/// An empty column of that type.
PlyColumn make_ply_column(PlyType type);

struct PlyHeaderProperty {
  std::string name;
  PlyType type = 0;
  bool is_list = false;
  PlyType length_type = 0;  // type of a list's length
};

struct PlyHeaderElement {
  std::string name;
  std::uint64_t rows = 0;  // number declared in the header
  std::vector<PlyHeaderProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<std::string> comments;
  std::vector<PlyHeaderElement> elements;
  std::size_t lines = 0;
};

/// Reads up to and including "end_header". `name` stands for the file in errors. Throws InputError for any line that is
/// not understood.
PlyHeader read_ply_header(const std::string& name, std::istream& in);

}  // namespace odosplat
