// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "odosplat/io/archive/compression.hpp"
#include "tests/splat/format/made_map.hpp"

namespace odosplat::test {

/// A ZIP archive of these members: name and content.
inline std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& members, bool compress = false) {
  std::string file;
  std::string directory;
  for (const auto& [name, content] : members) {
    const std::string data = compress ? deflated(content, -15) : content;
    const std::string common = little<std::uint16_t>(20) + little<std::uint16_t>(0) +
                               little<std::uint16_t>(compress ? 8 : 0) + little<std::uint32_t>(0) +
                               little(crc32_of(content)) + little(static_cast<std::uint32_t>(data.size())) +
                               little(static_cast<std::uint32_t>(content.size())) +
                               little(static_cast<std::uint16_t>(name.size())) + little<std::uint16_t>(0);
    directory += "PK\x01\x02" + little<std::uint16_t>(20) + common + little<std::uint16_t>(0) +
                 little<std::uint32_t>(0) + little<std::uint32_t>(0) + little(static_cast<std::uint32_t>(file.size())) +
                 name;
    file += "PK\x03\x04" + common + name + data;
  }
  const auto count = static_cast<std::uint16_t>(members.size());
  const std::string end = "PK\x05\x06" + little<std::uint32_t>(0) + little(count) + little(count) +
                          little(static_cast<std::uint32_t>(directory.size())) +
                          little(static_cast<std::uint32_t>(file.size())) + little<std::uint16_t>(0);
  return file + directory + end;
}

}  // namespace odosplat::test
