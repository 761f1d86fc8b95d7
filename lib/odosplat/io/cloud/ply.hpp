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

/// Values of one property, in the type the file has.
using PlyColumn = std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                               std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                               std::vector<float>, std::vector<double>>;

struct PlyProperty {
  std::string name;
  PlyColumn values;
};

/// One element of a PLY file ("vertex"): a table of scalar properties. List properties are read past, not kept.
struct PlyElement {
  std::string name;
  std::size_t count = 0;  // rows
  std::vector<PlyProperty> properties;

  bool has(const std::string& property) const { return find(property) != nullptr; }
  /// nullptr if there is none. A name in letters of another size counts where none is equal.
  const PlyColumn* find(const std::string& property) const;
  /// Appends a column; its length must be `count`, or sets `count` if it is the first. std::invalid_argument otherwise.
  void add(const std::string& property, PlyColumn values);
};

/// A PLY file in memory (Turk 1994: ascii, binary_little_endian, binary_big_endian, version 1.0).
struct Ply {
  std::string file;                   // name for errors
  std::vector<std::string> comments;  // the text behind "comment " and "obj_info "
  std::vector<PlyElement> elements;

  bool has(const std::string& element) const;
  /// InputError naming the file if there is none of that name.
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

/// Reads a whole file. Never allocates more than the file's size justifies. Throws InputError: not a PLY file, a header
/// line that is not understood, a header that promises more rows than the file holds (says how many it holds), an ascii
/// value that does not fit its type. NaN and infinite values are kept: what they mean is the caller's business. What
/// a file holds behind its last element is not read; where a row would fit, one warning says how much that is.
Ply read_ply(const std::string& path);
/// The same from memory; `name` stands for the file in errors.
Ply parse_ply(const std::string& name, const std::string& bytes);

/// Writes binary_little_endian, beside the path and renamed. std::invalid_argument if columns of an element differ in
/// length or a name holds blanks; InputError if the path cannot be written.
void write_ply(const std::string& path, const Ply& ply);

}  // namespace odosplat
