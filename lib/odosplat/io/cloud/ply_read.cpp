// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/cloud/ply_body.hpp"
#include "odosplat/io/cloud/ply_header.hpp"

namespace odosplat {
namespace {

Ply read_from(const std::string& name, std::istream& in, std::uint64_t size) {
  const PlyHeader header = read_ply_header(name, in);
  PlyBody body(name, in, header, size - static_cast<std::uint64_t>(in.tellg()));
  Ply ply;
  ply.file = name;
  ply.comments = header.comments;
  for (const PlyHeaderElement& element : header.elements) {
    body.begin(element);
    ply.elements.push_back(body.next(std::numeric_limits<std::uint64_t>::max()));
  }
  const std::string more = body.left_over();
  if (!more.empty()) log_warning(name + ": " + more);
  return ply;
}

}  // namespace

Ply read_ply(const std::string& path) {
  require_regular_file(path);
  std::error_code error;
  std::ifstream in(path, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!in || error) throw InputError(path, "cannot be read");
  return read_from(path, in, size);
}

Ply parse_ply(const std::string& name, const std::string& bytes) {
  std::istringstream in(bytes);
  return read_from(name, in, bytes.size());
}

}  // namespace odosplat
