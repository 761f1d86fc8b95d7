// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/cloud/ply_header.hpp"

namespace odosplat {

/// Reads the data after a PLY header, some rows at a time. Elements must be begun and read to their end in the order of
/// the header, which must outlive this object. The allocated memory is bounded by the bytes left in the file. Throws
/// InputError as read_ply does.
class PlyBody {
 public:
  /// in: positioned after "end_header", with bytes_left bytes until its end.
  PlyBody(std::string name, std::istream& in, const PlyHeader& header, std::uint64_t bytes_left);

  void begin(const PlyHeaderElement& promised);
  /// The next rows of the element, at most max_rows; count 0 at its end. Rows without properties take no bytes, so
  /// their declared number cannot be checked; such an element is read as having no rows.
  PlyElement next(std::uint64_t max_rows);

  /// To be called after the last element: a text about data beyond it ("the header promises 5 rows of vertex, the file
  /// goes on for ..."); empty if there are only blank lines, or fewer bytes than one row (padding).
  std::string left_over();

 private:
  [[noreturn]] void too_short(std::uint64_t held) const;
  [[noreturn]] void fail(const std::string& fault) const;
  void take(char* to, std::size_t n);
  void read_fixed_rows(std::uint64_t rows);
  void read_row_with_lists(std::uint64_t row);
  void read_ascii_row(std::uint64_t row);
  std::int64_t list_length(PlyType type, const char* bytes) const;
  double number();
  template <typename T>
  std::size_t spread(std::vector<T>& values, std::size_t first, std::size_t n, const char* source, std::size_t stride);
  template <typename T>
  void append(std::vector<T>& values);

  std::string name_;
  std::istream& in_;
  PlyFormat format_;
  std::size_t line_;
  std::uint64_t left_;
  bool swap_;
  const PlyHeaderElement* promised_ = nullptr;
  bool has_list_ = false;
  std::uint64_t done_ = 0;  // rows of the element
  PlyElement element_;
  std::string text_;
  std::string_view rest_;
};

}  // namespace odosplat
