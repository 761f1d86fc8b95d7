// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/cloud/ply_header.hpp"
#include "odosplat/io/foreign_format.hpp"
#include "odosplat/io/text/text_words.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/map_header.hpp"
#include "odosplat/splat/splat_file.hpp"

namespace odosplat {

namespace {

constexpr float full_logit = 20.0F;          // of an opacity that equals 1 in single precision (negative: 0)
constexpr float zero_log_scale = -23.0F;     // 1e-10 m: stands for a size of 0
constexpr float disc_log_scale = -13.8155F;  // 1e-6 m: the thickness of a disc

const std::string element_name = "vertex";
const std::vector<std::string> format_notes = {
    "odosplat map, format 1",
    "camera: x right, y down, z forward; pixel (0,0) is the centre of the top-left pixel; metres"};

/// One property of the file and where its values are stored: array[i * stride + offset].
struct Field {
  std::string name;
  std::vector<float>* values;
  std::size_t stride;
  std::size_t offset;
};

/// The layout, in the order of the public programs; nx ny nz come between the first three and the rest.
std::vector<Field> layout(Gaussians& gaussians) {
  std::vector<Field> fields;
  const char* axes[3] = {"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a) fields.push_back({axes[a], &gaussians.positions, 3, a});
  const auto k = static_cast<std::size_t>(gaussians.coefficients());
  for (std::size_t c = 0; c < 3; ++c) fields.push_back({"f_dc_" + std::to_string(c), &gaussians.sh, 3 * k, c});
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t j = 1; j < k; ++j)
      fields.push_back({"f_rest_" + std::to_string(c * (k - 1) + j - 1), &gaussians.sh, 3 * k, 3 * j + c});
  fields.push_back({"opacity", &gaussians.opacity_logits, 1, 0});
  for (std::size_t a = 0; a < 3; ++a) fields.push_back({"scale_" + std::to_string(a), &gaussians.log_scales, 3, a});
  for (std::size_t a = 0; a < 4; ++a) fields.push_back({"rot_" + std::to_string(a), &gaussians.rotations, 4, a});
  return fields;
}

std::optional<int> degree_of(std::size_t rest) {
  for (int degree = 0; degree <= 3; ++degree)
    if (rest == 3 * static_cast<std::size_t>(sh_coefficients(degree) - 1)) return degree;
  return std::nullopt;
}

Eigen::Vector3f shortest_axis(const Gaussians& gaussians, std::size_t i) {
  const float* scale = gaussians.log_scales.data() + 3 * i;
  const float* r = gaussians.rotations.data() + 4 * i;
  const Eigen::Quaternionf q(r[0], r[1], r[2], r[3]);
  if (!(q.norm() > 0.0F)) return Eigen::Vector3f::UnitZ();
  return q.normalized() * Eigen::Vector3f::Unit(std::min_element(scale, scale + 3) - scale);
}

/// The column of a field. Integers are refused: exporters that lack a type for half floats store their bits as ushort,
/// and no program writes whole numbers here.
std::vector<float> column_of(const Ply& ply, const Field& field) {
  const PlyColumn* column = ply.element(element_name).find(field.name);
  if (column != nullptr && !std::holds_alternative<std::vector<float>>(*column) &&
      !std::holds_alternative<std::vector<double>>(*column)) {
    const std::string type = ply_type_name(column->index());
    throw InputError(ply.file, element_name,
                     field.name + " is of type " + type + ", must be float or double" +
                         (type == "ushort" ? " (half floats stored as ushort: export the map as float)" : ""));
  }
  return ply.column<float>(element_name, field.name);
}

/// A value as Gaussians keep it. Opacities of 0 and 1 and a size of 0 have infinite logarithms.
float finite_value(const Field& field, float value) {
  if (field.name == "opacity" && std::isinf(value)) return std::copysign(full_logit, value);
  if (field.name.starts_with("scale_") && std::isinf(value) && value < 0.0F) return zero_log_scale;
  return value;
}

MapHeader header_of(const std::string& path, const std::vector<std::string>& comments) {
  std::vector<std::string> notes = comments;
  const bool is_ours = std::find(notes.begin(), notes.end(), format_notes.front()) != notes.end();
  std::erase_if(notes, [is_ours](const std::string& note) {
    return std::find(format_notes.begin(), format_notes.end(), note) != format_notes.end() ||
           (!is_ours && names_map_setting(note));
  });
  try {
    check_map_header(comments);
    return MapHeader::from_notes(std::move(notes));
  } catch (const InputError& e) {
    throw InputError(path, "header", e.what());
  }
}

Gaussians gaussians_from_ply(const Ply& ply) {
  const std::string& path = ply.file;
  const PlyElement& vertex = ply.element(element_name);
  std::vector<std::string> names;
  for (const PlyProperty& property : vertex.properties) names.push_back(property.name);
  refuse_packed_ply(path, names);
  const auto rest = static_cast<std::size_t>(
      std::count_if(vertex.properties.begin(), vertex.properties.end(),
                    [](const PlyProperty& property) { return same_word(property.name.substr(0, 7), "f_rest_"); }));
  const std::optional<int> degree = degree_of(rest);
  if (!degree)
    throw InputError(path, "header",
                     "has " + std::to_string(rest) + " properties f_rest_*, must be 0, 9, 24 or 45 (SH degree 0 to 3)");
  Gaussians gaussians;
  gaussians.sh_degree = *degree;
  gaussians.resize(vertex.count);
  // Discs in the plane of their first two axes, as 2D Gaussian splatting trains them (Huang et al. 2024).
  const bool is_flat = vertex.has("scale_0") && vertex.has("scale_1") && !vertex.has("scale_2");
  if (is_flat) log_info(path + ": is a map of 2-D Gaussians (two scales); they are read as flat discs");
  BrokenRows broken(path, vertex.count);
  for (const Field& field : layout(gaussians)) {
    const bool is_missing = is_flat && field.name == "scale_2";
    const std::vector<float> column =
        is_missing ? std::vector<float>(vertex.count, disc_log_scale) : column_of(ply, field);
    for (std::size_t i = 0; i < column.size(); ++i) {
      const float value = finite_value(field, column[i]);
      if (!std::isfinite(value)) broken.add(i, field.name + " is not finite");
      (*field.values)[i * field.stride + field.offset] = value;
    }
  }
  if (gaussians.empty()) throw InputError(path, "holds no Gaussians");
  broken.leave_out(gaussians);
  return gaussians;
}

Map map_from_ply(const Ply& ply) {
  MapHeader header = header_of(ply.file, ply.comments);
  return {gaussians_from_ply(ply), std::move(header)};
}

// Refuses a map so far from the origin that single precision has spoilt its positions, whichever program wrote it.
Map near_origin(const std::string& name, Map map) {
  const Gaussians& gaussians = map.gaussians;
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(gaussians.size());
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    positions.push_back(Eigen::Map<const Eigen::Vector3f>(&gaussians.positions[3 * i]).cast<double>());
  }
  require_near_origin(name, positions);
  return map;
}

void write_splat(const std::string& path, const Gaussians& gaussians, const std::vector<std::string>& notes) {
  if (blend_order_from_lines(notes) == BlendOrder::distance) {
    log_warning(path + ": .splat cannot say that these Gaussians are sorted by distance (train --blend-order depth)");
  }
  if (gaussians.sh_degree > 0) {
    log_warning(path + ": .splat has no place for the colour's change with direction: harmonics of degree 1 to " +
                std::to_string(gaussians.sh_degree) + " are left out");
  }
  write_file_atomically(path, splat_bytes(gaussians));
}

/// Empty if it is no regular file or cannot be read.
std::string first_bytes(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};  // opening a FIFO would wait for its writer
  std::ifstream in(path, std::ios::binary);
  std::string bytes(16, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

bool is_splat_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".splat";
}

bool is_map_file(const std::string& path) {
  if (is_splat_path(path)) return true;
  const std::string start = first_bytes(path);
  const bool is_marked = start.starts_with(byte_order_mark);
  if (!std::string_view(start).substr(is_marked ? byte_order_mark.size() : 0).starts_with("ply")) return false;
  std::ifstream in(path, std::ios::binary);
  for (const PlyHeaderElement& element : read_ply_header(path, in).elements) {
    if (!same_word(element.name, element_name)) continue;
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [](const PlyHeaderProperty& property) { return same_word(property.name, "f_dc_0"); });
  }
  return false;
}

Map read_map(const std::string& path) {
  refuse_foreign_format(path, first_bytes(path));
  return near_origin(path, is_splat_path(path) ? Map{parse_splat(path, read_file(path, max_data_bytes)), {}}
                                               : map_from_ply(read_ply(path)));
}

Map parse_map(const std::string& name, const std::string& bytes) {
  refuse_foreign_format(name, bytes);
  return near_origin(name,
                     is_splat_path(name) ? Map{parse_splat(name, bytes), {}} : map_from_ply(parse_ply(name, bytes)));
}

MapHeader read_map_header(const std::string& path) {
  const std::string start = first_bytes(path);
  if (start.empty()) read_file(path, max_data_bytes);  // throws with the reason why it cannot be read
  refuse_foreign_format(path, start);
  if (is_splat_path(path)) return {};
  std::ifstream file(path, std::ios::binary);
  return header_of(path, read_ply_header(path, file).comments);
}

void write_map(const std::string& path, const Map& map) { write_map(path, map.gaussians, map.header.notes); }

void write_map(const std::string& path, const Gaussians& gaussians, const std::vector<std::string>& notes) {
  gaussians.check();
  if (gaussians.empty()) throw InputError(path, "there are no Gaussians to write");
  if (is_splat_path(path)) {
    write_splat(path, gaussians, notes);
    return;
  }
  Ply ply;
  ply.file = path;
  ply.comments = format_notes;
  ply.comments.insert(ply.comments.end(), notes.begin(), notes.end());

  PlyElement vertex;
  vertex.name = element_name;
  const std::size_t n = gaussians.size();
  std::array<std::vector<float>, 3> normals;
  for (auto& axis : normals) axis.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f normal = shortest_axis(gaussians, i);
    for (std::size_t a = 0; a < 3; ++a) normals[a][i] = normal[static_cast<Eigen::Index>(a)];
  }
  Gaussians copy = gaussians;  // layout() names the arrays to write as well as to read
  for (const Field& field : layout(copy)) {
    std::vector<float> column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = (*field.values)[i * field.stride + field.offset];
    vertex.add(field.name, std::move(column));
    if (field.name != "z") continue;
    vertex.add("nx", std::move(normals[0]));
    vertex.add("ny", std::move(normals[1]));
    vertex.add("nz", std::move(normals[2]));
  }
  ply.elements.push_back(std::move(vertex));
  write_ply(path, ply);
}

}  // namespace odosplat
