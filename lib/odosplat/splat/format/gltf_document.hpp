// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "odosplat/splat/format/foreign_map.hpp"

namespace odosplat::gltf {

inline constexpr const char* extension = "KHR_gaussian_splatting";
inline constexpr const char* rotation = "KHR_gaussian_splatting:ROTATION";
inline constexpr const char* scale = "KHR_gaussian_splatting:SCALE";
inline constexpr const char* opacity = "KHR_gaussian_splatting:OPACITY";
inline constexpr const char* extras = "odosplat_map";  // of the mesh: lines of the header
/// "KHR_gaussian_splatting:SH_DEGREE_l_COEF_n" of coefficient j, degree after degree.
std::string harmonic_attribute(std::size_t j);

inline constexpr std::string_view binary_magic = "glTF";
inline constexpr std::string_view json_chunk = "JSON";
inline constexpr std::string_view binary_chunk("BIN\0", 4);
inline constexpr std::size_t binary_header = 12;
inline constexpr std::size_t chunk_header = 8;

inline constexpr int component_byte = 5120;
inline constexpr int component_unsigned_byte = 5121;
inline constexpr int component_short = 5122;
inline constexpr int component_unsigned_short = 5123;
inline constexpr int component_float = 5126;
inline constexpr int target_vertices = 34962;
inline constexpr int mode_points = 0;

/// A glTF file: its JSON, and access to its buffers. Errors are InputError(file, place, fault), the place as in
/// "accessors[3].count".
class Document {
 public:
  /// Splits a binary file, or takes the text as JSON. `bytes` must outlive this.
  Document(std::string name, const std::string& bytes, ReadSibling read_sibling);

  const std::string& name() const { return name_; }
  const nlohmann::json& json() const { return json_; }
  /// Bytes of the file and of the buffers that were read so far.
  std::size_t stored() const { return stored_; }

  /// Element `index` of the array `list` at the top; `from` is the place that refers to it.
  const nlohmann::json& element(const char* list, const nlohmann::json& index, const std::string& from) const;
  /// A whole number of at least 0; `fallback` if the member is missing and may be.
  std::size_t whole(const nlohmann::json& object, const char* member, const std::string& place,
                    const std::size_t* fallback = nullptr) const;
  /// Bytes of a buffer view.
  std::string_view view(const nlohmann::json& index, const std::string& from);
  /// Values of an accessor of `width` components, Gaussian after Gaussian, as floats; normalised integers in 0..1 or
  /// -1..1.
  std::vector<float> accessor(const nlohmann::json& index, std::size_t width, const std::string& from);

  [[noreturn]] void fail(const std::string& place, const std::string& fault) const;

 private:
  const std::string& buffer(std::size_t index);

  std::string name_;
  ReadSibling read_sibling_;
  nlohmann::json json_;
  std::size_t stored_ = 0;
  std::string binary_;
  bool has_binary_ = false;
  std::map<std::size_t, std::string> buffers_;
};

}  // namespace odosplat::gltf
