// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/cloud/ply_header.hpp"

namespace odosplat {
namespace {

void require_word(const std::string& word) {
  if (word.empty() || word.find_first_of(" \t\r\n") != std::string::npos) {
    throw std::invalid_argument("PLY name `" + word + "` must be a word");
  }
}

std::string header_of(const Ply& ply) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (std::string comment : ply.comments) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    text += "comment " + comment + "\n";
  }
  for (const PlyElement& element : ply.elements) {
    require_word(element.name);
    text += "element " + element.name + " " + std::to_string(element.count) + "\n";
    for (const PlyProperty& p : element.properties) {
      require_word(p.name);
      std::visit(
          [&](const auto& values) {
            if (values.size() != element.count)
              throw std::invalid_argument("PLY column " + p.name + " has a wrong length");
          },
          p.values);
      text += std::string("property ") + ply_type_name(p.values.index()) + " " + p.name + "\n";
    }
  }
  return text + "end_header\n";
}

template <typename T>
std::size_t gather(const std::vector<T>& values, std::size_t first, std::size_t n, char* target, std::size_t stride) {
  for (std::size_t i = 0; i < n; ++i) {
    char* bytes = target + i * stride;
    std::memcpy(bytes, &values[first + i], sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(T));
  }
  return sizeof(T);
}

void write_rows(const PlyElement& element, AtomicFile& file) {
  std::size_t stride = 0;
  for (const PlyProperty& p : element.properties) stride += ply_size(p.values.index());
  if (stride == 0) return;
  const std::size_t block_rows = std::max<std::size_t>(1, (std::size_t{1} << 20) / stride);
  std::string block;
  for (std::size_t first = 0; first < element.count; first += block_rows) {
    const std::size_t n = std::min(block_rows, element.count - first);
    block.resize(n * stride);
    char* target = block.data();
    for (const PlyProperty& p : element.properties) {
      target += std::visit([&](const auto& values) { return gather(values, first, n, target, stride); }, p.values);
    }
    file.write(block);
  }
}

}  // namespace

void write_ply(const std::string& path, const Ply& ply) {
  const std::string header = header_of(ply);
  AtomicFile file(path);
  file.write(header);
  for (const PlyElement& element : ply.elements) write_rows(element, file);
  file.commit();
}

}  // namespace odosplat
