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
constexpr std::array<Format, 9> formats{
    {{".spz", "NGSP", "is a map of Gaussians in SPZ: `odosplat convert` makes a PLY of it"},
     {".sog", "", "is a map of Gaussians in SOG: `odosplat convert` makes a PLY of it"},
     {".ksplat", "", "is a map in KSPLAT, which is not read: convert it to PLY first, as with splat-transform"},
     {".glb", "glTF", "is glTF, which is read as a map of Gaussians alone: `odosplat convert` makes a PLY of one"},
     {".gltf", "", "is glTF, which is read as a map of Gaussians alone: `odosplat convert` makes a PLY of one"},
     {".e57", "ASTM-E57", "is a cloud in E57, which is not read: convert it to PLY or LAS first, as with CloudCompare"},
     {"", gzip,
      "is compressed (gzip): unpack it first, or, if it is a map in SPZ, let `odosplat convert` make a PLY of it"},
     {"", zip, "is a ZIP archive: unpack it first, or, if it is a map in SOG, let `odosplat convert` make a PLY of it"},
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
  throw InputError(name, "is a packed PLY (SuperSplat), a map of Gaussians: `odosplat convert` makes a PLY of it");
}

}  // namespace odosplat
