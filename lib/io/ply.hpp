// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace odosplat {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::size_t offset = 0;  // of the value in a row [bytes]
};

/// A table of `count` rows. Lists (faces) are read over and dropped: only the scalar properties are kept.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t stride = 0;           // [bytes] a row
  std::vector<unsigned char> rows;  // count * stride, values in this machine's byte order

  bool has(const std::string& property) const { return find(property) != nullptr; }
  const PlyProperty* find(const std::string& property) const;
  /// All values of a property, converted; integers keep their value (255 stays 255). std::out_of_range if it is not
  /// there.
  std::vector<float> column(const std::string& property) const;
  std::vector<double> column_double(const std::string& property) const;
};

struct PlyFile {
  std::vector<std::string> comments;
  std::vector<PlyElement> elements;

  /// Null if there is no such element.
  const PlyElement* find(const std::string& element) const;
};

/// Reads a PLY 1.0 file: ascii, binary_little_endian, binary_big_endian; any scalar types by either of their names.
/// Throws InputError(file, place, fault): not a PLY, a header that is not closed or not understood, a value that is no
/// number, fewer rows than the header promises (it says how many there are), a list that reaches past the end. Never
/// allocates more than a small multiple of the file's size, whatever the header promises. Bytes after the last element
/// are ignored.
PlyFile read_ply(const std::string& path);
/// The same from bytes; `name` stands for the file in errors.
PlyFile parse_ply(const std::string& name, const std::string& bytes);

/// A property to write; all columns of a file have the same length.
struct PlyColumn {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint8_t>> values;
};

/// Writes one element as binary little endian, beside and renamed. Comments must not hold line breaks.
/// std::logic_error if the columns differ in length.
void write_ply(const std::string& path, const std::vector<std::string>& comments, const std::string& element,
               const std::vector<PlyColumn>& columns);

}  // namespace odosplat
