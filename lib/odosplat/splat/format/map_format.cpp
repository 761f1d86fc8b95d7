// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/map_format.hpp"

#include <filesystem>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

std::string_view without_mark(std::string_view bytes) {
  return bytes.substr(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
}

/// By a mark of four bytes at least, which no .splat begins with: its first value is a coordinate, and these are of
/// 1e-32 m or 800 km.
std::optional<MapFormat> certain_format(std::string_view bytes) {
  const std::string_view text = without_mark(bytes);
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ")) return MapFormat::ply;
  if (bytes.starts_with("NGSP")) return MapFormat::spz;
  if (bytes.starts_with("glTF")) return MapFormat::gltf;
  if (bytes.starts_with("PK\x03\x04")) return MapFormat::sog;
  return std::nullopt;
}

/// JSON of glTF, or of SOG without an archive, by a member that every such file has, where the name does not say it.
std::optional<MapFormat> json_format(std::string_view bytes, const std::optional<MapFormat>& by_name) {
  const std::string_view text = without_mark(bytes);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || text[start] != '{') return std::nullopt;
  if (by_name == MapFormat::gltf || by_name == MapFormat::sog) return by_name;
  if (text.find("\"means\"") != std::string_view::npos) return MapFormat::sog;
  if (text.find("\"asset\"") != std::string_view::npos) return MapFormat::gltf;
  return std::nullopt;
}

}  // namespace

const char* format_name(MapFormat format) {
  switch (format) {
    case MapFormat::ply:
      return "PLY";
    case MapFormat::splat:
      return ".splat";
    case MapFormat::spz:
      return "SPZ";
    case MapFormat::gltf:
      return "glTF";
    case MapFormat::sog:
      return "SOG";
  }
  return "";
}

std::optional<MapFormat> format_of_name(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string extension = name.extension().string();
  if (same_word(extension, ".ply")) return MapFormat::ply;
  if (same_word(extension, ".splat")) return MapFormat::splat;
  if (same_word(extension, ".spz")) return MapFormat::spz;
  if (same_word(extension, ".glb") || same_word(extension, ".gltf")) return MapFormat::gltf;
  if (same_word(extension, ".sog") || same_word(name.string(), "meta.json")) return MapFormat::sog;
  return std::nullopt;
}

std::optional<MapFormat> format_of_content(const std::string& path, std::string_view first_bytes) {
  const std::optional<MapFormat> by_name = format_of_name(path);
  if (const std::optional<MapFormat> certain = certain_format(first_bytes)) return certain;
  if (by_name == MapFormat::splat) return by_name;
  if (first_bytes.starts_with("\x1f\x8b")) return MapFormat::spz;  // versions 1 to 3 are gzip
  return json_format(first_bytes, by_name);
}

void require_format_of_name(const std::string& path, const std::optional<MapFormat>& found) {
  const std::optional<MapFormat> by_name = format_of_name(path);
  if (!by_name || found || by_name == MapFormat::ply) return;
  throw InputError(path, std::string("is no ") + format_name(*by_name) + ", as its name says, nor another map");
}

void warn_of_other_format(const std::string& path, MapFormat found) {
  const std::optional<MapFormat> by_name = format_of_name(path);
  if (!by_name || by_name == found) return;
  log_warning(path + ": is named as " + format_name(*by_name) + ", but holds " + format_name(found) +
              ", and is read so");
}

}  // namespace odosplat
