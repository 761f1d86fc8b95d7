// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace odosplat {

/// Values of one property, in the type of the file.
using PlyColumn = std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                               std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                               std::vector<float>, std::vector<double>>;

struct PlyProperty {
  std::string name;
  PlyColumn values;
};

/// One element of a PLY file ("vertex"): a table of scalar properties. List properties are skipped.
struct PlyElement {
  std::string name;
  std::size_t count = 0;  // rows
  std::vector<PlyProperty> properties;

  bool has(const std::string& property) const { return find(property) != nullptr; }
  /// nullptr if there is none. A name that differs only in upper and lower case is used if no name is equal.
  const PlyColumn* find(const std::string& property) const;
  /// Appends a column. The first column sets `count`; the length of any other must equal it, else
  /// std::invalid_argument.
  void add(const std::string& property, PlyColumn values);
};

/// A PLY file in memory (Turk 1994: ascii, binary_little_endian, binary_big_endian, version 1.0).
struct Ply {
  std::string file;                   // name for errors
  std::vector<std::string> comments;  // the text after "comment " and "obj_info "
  std::vector<PlyElement> elements;

  bool has(const std::string& element) const;
  /// Throws InputError naming the file if there is no element of that name.
  const PlyElement& element(const std::string& element_name) const;

  /// A property as vector<T>, converted by static_cast. InputError naming file, element and property if missing.
  template <typename T>
  std::vector<T> column(const std::string& element_name, const std::string& property) const {
    return std::visit(
        [](const auto& values) {
          if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<T>>) {
            return values;
          } else {
            std::vector<T> converted(values.size());
            for (std::size_t i = 0; i < values.size(); ++i) converted[i] = static_cast<T>(values[i]);
            return converted;
          }
        },
        values_of(element_name, property));
  }

 private:
  const PlyColumn& values_of(const std::string& element_name, const std::string& property) const;
};

/// Reads a whole file. The allocated memory is bounded by the file's size. Throws InputError: not a PLY file, a header
/// line that is not understood, a header that declares more rows than the file has (the error gives the number that it
/// has), an ascii value that does not fit its type. NaN and infinite values are kept for the caller to interpret. Data
/// after the last element is not read; if it is large enough for another row, one warning gives its amount.
Ply read_ply(const std::string& path);
/// The same from memory; `name` stands for the file in errors.
Ply parse_ply(const std::string& name, const std::string& bytes);

/// Writes binary_little_endian through AtomicFile. Throws std::invalid_argument if columns of an element differ in
/// length or a name contains blanks, InputError if the path cannot be written.
void write_ply(const std::string& path, const Ply& ply);

}  // namespace odosplat
