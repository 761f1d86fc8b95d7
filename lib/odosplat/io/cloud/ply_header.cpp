// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/ply_header.hpp"

#include <array>
#include <charconv>
#include <set>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

struct TypeNames {
  const char* usual;
  const char* sized;
  std::size_t size;
};

// In the order of PlyColumn.
constexpr std::array<TypeNames, 8> types{{{"char", "int8", 1},
                                          {"uchar", "uint8", 1},
                                          {"short", "int16", 2},
                                          {"ushort", "uint16", 2},
                                          {"int", "int32", 4},
                                          {"uint", "uint32", 4},
                                          {"float", "float32", 4},
                                          {"double", "float64", 8}}};
static_assert(types.size() == std::variant_size_v<PlyColumn>);

// Far above any real header; they stop the reading of binary data without line ends early.
constexpr std::size_t max_header_line = 1 << 14;
constexpr std::size_t max_header_lines = 1 << 14;

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::string& name, std::istream& in) : name_(name), in_(in) {}

  PlyHeader read() {
    const std::string first = next_line();
    if (without_byte_order_mark(name_, first) != "ply") throw InputError(name_, "is not a PLY file");
    bool has_format = false;
    for (std::string line = next_line(); line != "end_header"; line = next_line()) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "comment" || key == "obj_info") {
        header_.comments.push_back(line.substr(std::min(line.size(), key.size() + 1)));
      } else if (key == "format") {
        read_format(words);
        has_format = true;
      } else if (key == "element") {
        read_element(words);
      } else if (key == "property") {
        read_property(words);
      } else if (!key.empty()) {
        fail("`" + key.substr(0, 24) + "` is not understood");
      }
    }
    if (!has_format) throw InputError(name_, "the header names no format");
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(name_, "line " + std::to_string(header_.lines), fault);
  }

  std::string next_line() {
    std::string line;
    char c = 0;
    while (in_.get(c) && c != '\n') {
      line.push_back(c);
      if (line.size() > max_header_line) throw InputError(name_, "is not a PLY file");
    }
    if (!in_) throw InputError(name_, header_.lines == 0 ? "is not a PLY file" : "ends within the header");
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (++header_.lines > max_header_lines) fail("the header is too long");
    return line;
  }

  void read_format(std::istringstream& words) {
    std::string format;
    std::string version;
    words >> format >> version;
    if (format == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::binary_little_endian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::binary_big_endian;
    } else {
      fail("unknown format `" + format.substr(0, 24) + "`");
    }
    if (version != "1.0") fail("unknown version `" + version.substr(0, 24) + "`");
  }

  void read_element(std::istringstream& words) {
    PlyHeaderElement element;
    std::string rows;
    words >> element.name >> rows;
    const auto [end, error] = std::from_chars(rows.data(), rows.data() + rows.size(), element.rows);
    if (rows.empty() || error != std::errc() || end != rows.data() + rows.size()) {
      fail("`" + rows.substr(0, 24) + "` is not a number of rows");
    }
    if (!names_.insert(element.name).second) fail("element " + element.name + " comes twice");
    header_.elements.push_back(element);
    property_names_.clear();
  }

  void read_property(std::istringstream& words) {
    if (header_.elements.empty()) fail("property before any element");
    PlyHeaderProperty property;
    std::string type;
    words >> type;
    property.is_list = type == "list";
    if (property.is_list) {
      words >> type;
      property.length_type = type_of(type);
      if (property.length_type >= 6) fail("the length of a list must be a whole number");
      words >> type;
    }
    property.type = type_of(type);
    words >> property.name;
    if (property.name.empty()) fail("property without a name");
    if (!property_names_.insert(property.name).second) fail("property " + property.name + " comes twice");
    header_.elements.back().properties.push_back(property);
  }

  PlyType type_of(const std::string& word) const {
    for (PlyType type = 0; type < types.size(); ++type) {
      if (word == types[type].usual || word == types[type].sized) return type;
    }
    fail("unknown type `" + word.substr(0, 24) + "`");
  }

  const std::string& name_;
  std::istream& in_;
  PlyHeader header_;
  std::set<std::string> names_;
  std::set<std::string> property_names_;
};

template <std::size_t... Types>
PlyColumn column_of(PlyType type, std::index_sequence<Types...>) {
  PlyColumn column;
  ((type == Types ? void(column.emplace<Types>()) : void()), ...);
  return column;
}

}  // namespace

std::size_t ply_size(PlyType type) { return types[type].size; }
const char* ply_type_name(PlyType type) { return types[type].usual; }
PlyColumn make_ply_column(PlyType type) { return column_of(type, std::make_index_sequence<types.size()>()); }

PlyHeader read_ply_header(const std::string& name, std::istream& in) { return PlyHeaderReader(name, in).read(); }

}  // namespace odosplat
