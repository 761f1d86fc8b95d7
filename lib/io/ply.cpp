// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/ply.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are kept as binary_little_endian files have them");

enum class Format { ascii, little, big };

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

std::optional<PlyType> type_called(std::string_view word) {
  static const std::map<std::string_view, PlyType> types{
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto it = types.find(word);
  return it == types.end() ? std::nullopt : std::optional(it->second);
}

template <typename T>
double load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double load(const unsigned char* at, PlyType type) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>(at);
    case PlyType::uint8:
      return load<std::uint8_t>(at);
    case PlyType::int16:
      return load<std::int16_t>(at);
    case PlyType::uint16:
      return load<std::uint16_t>(at);
    case PlyType::int32:
      return load<std::int32_t>(at);
    case PlyType::uint32:
      return load<std::uint32_t>(at);
    case PlyType::float32:
      return load<float>(at);
    default:
      return load<double>(at);
  }
}

template <typename T>
void store_integer(unsigned char* at, double value) {
  const double low = static_cast<double>(std::numeric_limits<T>::lowest());
  const double high = static_cast<double>(std::numeric_limits<T>::max());
  const T converted = static_cast<T>(std::isnan(value) ? 0.0 : std::clamp(value, low, high));
  std::memcpy(at, &converted, sizeof(T));
}

void store(unsigned char* at, PlyType type, double value) {
  switch (type) {
    case PlyType::int8:
      return store_integer<std::int8_t>(at, value);
    case PlyType::uint8:
      return store_integer<std::uint8_t>(at, value);
    case PlyType::int16:
      return store_integer<std::int16_t>(at, value);
    case PlyType::uint16:
      return store_integer<std::uint16_t>(at, value);
    case PlyType::int32:
      return store_integer<std::int32_t>(at, value);
    case PlyType::uint32:
      return store_integer<std::uint32_t>(at, value);
    case PlyType::float32: {
      // Values beyond float's range become infinite, as a cast of them is undefined.
      const bool fits = std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) || std::isnan(value);
      const float converted =
          fits ? static_cast<float>(value) : std::copysign(INFINITY, static_cast<float>(value > 0 ? 1 : -1));
      std::memcpy(at, &converted, sizeof(converted));
      return;
    }
    default:
      std::memcpy(at, &value, sizeof(value));
  }
}

// A property as the header has it: lists are needed to walk over their bytes.
struct Field {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
  std::size_t offset = 0;
};

struct Header {
  Format format = Format::ascii;
  std::vector<std::string> comments;
  struct Element {
    PlyElement table;
    std::vector<Field> fields;
  };
  std::vector<Element> elements;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

class Parser {
 public:
  Parser(const std::string& name, const std::string& bytes) : name_(name), rest_(bytes) {}

  PlyFile parse() {
    read_header();
    PlyFile file;
    file.comments = std::move(header_.comments);
    for (Header::Element& element : header_.elements) {
      read_rows(element);
      file.elements.push_back(std::move(element.table));
    }
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& fault) const {
    throw InputError(name_, place, fault);
  }

  std::string_view next_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("header", "ends before end_header");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }

  void read_header() {
    if (rest_.substr(0, 3) != "ply") fail("header", "is not a PLY file");
    next_line();
    bool has_format = false;
    for (int number = 2;; ++number) {
      const std::string_view line = next_line();
      const std::vector<std::string_view> words = words_of(line);
      const std::string place = "header line " + std::to_string(number);
      if (words.empty() || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "comment") {
        const std::size_t at = line.find("comment") + 8;
        std::string text(line.size() > at ? line.substr(at) : std::string_view());
        if (!text.empty() && text.back() == '\r') text.pop_back();
        header_.comments.push_back(text);
      } else if (words[0] == "format") {
        has_format = true;
        read_format(words, place);
      } else if (words[0] == "element") {
        read_element(words, place);
      } else if (words[0] == "property") {
        read_property(words, place);
      } else {
        fail(place, "is not understood");
      }
    }
    if (!has_format) fail("header", "has no format line");
  }

  void read_format(const std::vector<std::string_view>& words, const std::string& place) {
    if (words.size() < 2) fail(place, "has no format");
    if (words[1] == "ascii") {
      header_.format = Format::ascii;
    } else if (words[1] == "binary_little_endian") {
      header_.format = Format::little;
    } else if (words[1] == "binary_big_endian") {
      header_.format = Format::big;
    } else {
      fail(place, "unknown format " + std::string(words[1].substr(0, 32)));
    }
  }

  void read_element(const std::vector<std::string_view>& words, const std::string& place) {
    std::uint64_t count = 0;
    if (words.size() != 3) fail(place, "an element needs a name and a count");
    const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
    if (error != std::errc() || end != words[2].data() + words[2].size()) fail(place, "the count is no number");
    Header::Element element;
    element.table.name = words[1];
    element.table.count = count;
    header_.elements.push_back(std::move(element));
  }

  void read_property(const std::vector<std::string_view>& words, const std::string& place) {
    if (header_.elements.empty()) fail(place, "a property before any element");
    Field field;
    field.is_list = words.size() == 5 && words[1] == "list";
    if (words.size() != (field.is_list ? 5U : 3U)) fail(place, "a property needs a type and a name");
    const std::optional<PlyType> type = type_called(words[field.is_list ? 3 : 1]);
    const std::optional<PlyType> count_type = field.is_list ? type_called(words[2]) : PlyType::uint8;
    if (!type || !count_type) fail(place, "unknown type");
    field.name = words.back();
    field.type = *type;
    field.count_type = *count_type;
    Header::Element& element = header_.elements.back();
    if (!field.is_list) {
      if (element.table.has(field.name)) fail(place, "property " + field.name + " stands twice");
      field.offset = element.table.stride;
      element.table.properties.push_back({field.name, field.type, field.offset});
      element.table.stride += size_of(field.type);
    }
    element.fields.push_back(std::move(field));
  }

  [[noreturn]] void fail_short(const PlyElement& table, std::size_t rows) const {
    fail("element " + table.name,
         "the header promises " + std::to_string(table.count) + " rows, the file holds " + std::to_string(rows));
  }

  void read_rows(Header::Element& element) {
    PlyElement& table = element.table;
    if (element.fields.empty()) {
      if (table.count > 0) fail("element " + table.name, "has rows but no properties");
      return;
    }
    const bool plain = element.fields.size() == table.properties.size();
    if (header_.format == Format::little && plain) {
      const std::size_t whole = rest_.size() / table.stride;
      if (whole < table.count) fail_short(table, whole);
      table.rows.assign(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(table.count * table.stride));
      rest_.remove_prefix(table.count * table.stride);
      return;
    }
    // Every row takes a byte of the file at least, so this bounds what a lying header can make us reserve.
    table.rows.reserve(std::min<std::uint64_t>(table.count, rest_.size()) * table.stride);
    for (std::size_t row = 0; row < table.count; ++row) {
      table.rows.resize((row + 1) * table.stride);
      unsigned char* at = table.rows.data() + row * table.stride;
      const bool ok = header_.format == Format::ascii ? read_ascii_row(element, row, at) : read_binary_row(element, at);
      if (!ok) fail_short(table, row);
    }
  }

  // The next word of the body; empty at the end.
  std::string_view next_word() {
    const std::size_t start = rest_.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return {};
    rest_.remove_prefix(start);
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

  bool next_number(const PlyElement& table, std::size_t row, double& value) {
    std::string_view word = next_word();
    if (word.empty()) return false;
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      fail("element " + table.name + " row " + std::to_string(row),
           "`" + std::string(word.substr(0, 24)) + "` is not a number");
    }
    return true;
  }

  bool read_ascii_row(const Header::Element& element, std::size_t row, unsigned char* at) {
    for (const Field& field : element.fields) {
      double value = 0.0;
      if (!next_number(element.table, row, value)) return false;
      if (!field.is_list) {
        store(at + field.offset, field.type, value);
        continue;
      }
      for (double left = value; left >= 1.0; left -= 1.0) {
        if (!next_number(element.table, row, value)) return false;
      }
    }
    return true;
  }

  bool take(std::size_t size, unsigned char* out) {
    if (rest_.size() < size) return false;
    std::memcpy(out, rest_.data(), size);
    if (header_.format == Format::big) std::reverse(out, out + size);
    rest_.remove_prefix(size);
    return true;
  }

  bool read_binary_row(const Header::Element& element, unsigned char* at) {
    for (const Field& field : element.fields) {
      if (!field.is_list) {
        if (!take(size_of(field.type), at + field.offset)) return false;
        continue;
      }
      unsigned char bytes[8];
      if (!take(size_of(field.count_type), bytes)) return false;
      const double count = load(bytes, field.count_type);
      const double size = static_cast<double>(size_of(field.type));
      if (!(count >= 0.0) || count * size > static_cast<double>(rest_.size())) return false;
      rest_.remove_prefix(static_cast<std::size_t>(count) * size_of(field.type));
    }
    return true;
  }

  const std::string& name_;
  std::string_view rest_;
  Header header_;
};

template <typename T>
std::vector<T> column_of(const PlyElement& element, const std::string& name) {
  const PlyProperty* property = element.find(name);
  if (property == nullptr) throw std::out_of_range("no property " + name);
  std::vector<T> values(element.count);
  for (std::size_t i = 0; i < element.count; ++i) {
    const unsigned char* at = element.rows.data() + i * element.stride + property->offset;
    values[i] = static_cast<T>(load(at, property->type));
  }
  return values;
}

std::size_t length_of(const PlyColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

}  // namespace

const PlyProperty* PlyElement::find(const std::string& property) const {
  for (const PlyProperty& p : properties) {
    if (p.name == property) return &p;
  }
  return nullptr;
}

std::vector<float> PlyElement::column(const std::string& property) const { return column_of<float>(*this, property); }

std::vector<double> PlyElement::column_double(const std::string& property) const {
  return column_of<double>(*this, property);
}

const PlyElement* PlyFile::find(const std::string& element) const {
  for (const PlyElement& e : elements) {
    if (e.name == element) return &e;
  }
  return nullptr;
}

PlyFile parse_ply(const std::string& name, const std::string& bytes) { return Parser(name, bytes).parse(); }

PlyFile read_ply(const std::string& path) { return parse_ply(path, read_file(path)); }

void write_ply(const std::string& path, const std::vector<std::string>& comments, const std::string& element,
               const std::vector<PlyColumn>& columns) {
  const std::size_t count = columns.empty() ? 0 : length_of(columns.front());
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) bytes += "comment " + comment + "\n";
  bytes += "element " + element + " " + std::to_string(count) + "\n";
  std::size_t stride = 0;
  for (const PlyColumn& column : columns) {
    if (length_of(column) != count) throw std::logic_error("PLY column " + column.name + " has another length");
    const bool is_float = std::holds_alternative<std::vector<float>>(column.values);
    bytes += std::string("property ") + (is_float ? "float " : "uchar ") + column.name + "\n";
    stride += is_float ? 4 : 1;
  }
  bytes += "end_header\n";
  std::size_t offset = bytes.size();
  bytes.resize(bytes.size() + count * stride);
  for (const PlyColumn& column : columns) {
    std::visit(
        [&](const auto& values) {
          constexpr std::size_t size = sizeof(values[0]);
          for (std::size_t i = 0; i < count; ++i) std::memcpy(bytes.data() + offset + i * stride, &values[i], size);
          offset += size;
        },
        column.values);
  }
  write_file_atomically(path, bytes);
}

}  // namespace odosplat
