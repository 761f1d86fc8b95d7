// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/foreign_format.hpp"

#include <algorithm>
#include <array>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

struct Format {
  const char* extension;   // empty: recognised by its first bytes only
  std::string_view magic;  // empty: recognised by its extension only
  const char* fault;
};

constexpr std::string_view gzip = "\x1f\x8b";
constexpr std::string_view zip = "PK\x03\x04";

// If both are given, one of them is enough. Archives come last, so that the extension of a map that is stored as an
// archive (.spz, .sog) is recognised first.
constexpr std::array<Format, 8> formats{
    {{".spz", "NGSP", "is a map in SPZ, which is not read: convert it to PLY first, as with splat-transform"},
     {".sog", "", "is a map in SOG, which is not read: convert it to PLY first, as with splat-transform"},
     {".ksplat", "", "is a map in KSPLAT, which is not read: convert it to PLY first, as with splat-transform"},
     {".glb", "glTF", "is glTF, which is not read: convert it to PLY first"},
     {".e57", "ASTM-E57", "is a cloud in E57, which is not read: convert it to PLY or LAS first, as with CloudCompare"},
     {"", gzip, "is compressed (gzip): unpack it first; a map in SPZ must be converted to PLY"},
     {"", zip, "is a ZIP archive: unpack it first; a map in SOG must be converted to PLY"},
     {"", "\x28\xb5\x2f\xfd", "is compressed (zstd): unpack it first"}}};

bool has_extension(std::string_view name, std::string_view extension) {
  return !extension.empty() && name.size() > extension.size() &&
         same_word(name.substr(name.size() - extension.size()), extension);
}

}  // namespace

void refuse_foreign_format(const std::string& name, std::string_view first_bytes) {
  for (const Format& format : formats) {
    const bool begins = !format.magic.empty() && first_bytes.starts_with(format.magic);
    if (begins || has_extension(name, format.extension)) throw InputError(name, format.fault);
  }
}

void refuse_packed_ply(const std::string& name, const std::vector<std::string>& properties) {
  if (std::find(properties.begin(), properties.end(), "packed_position") == properties.end()) return;
  throw InputError(name, "is a compressed PLY (SuperSplat), which is not read: export it uncompressed");
}

}  // namespace odosplat
