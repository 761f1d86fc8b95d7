// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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
#include "odosplat/splat/format/gltf.hpp"
#include "odosplat/splat/format/map_format.hpp"
#include "odosplat/splat/format/packed_ply.hpp"
#include "odosplat/splat/format/quantized.hpp"
#include "odosplat/splat/format/sog.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/map_header.hpp"
#include "odosplat/splat/splat_file.hpp"

namespace odosplat {

namespace {

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
  if (field.name == "opacity" && std::isinf(value)) return std::copysign(full_opacity_logit, value);
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
  return {is_packed_ply(ply) ? gaussians_from_packed_ply(ply) : gaussians_from_ply(ply), std::move(header)};
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

/// One line of what a file of this format cannot hold. The header is not counted as lost where only programs other than
/// this one cannot read it.
void warn_of_losses(const std::string& path, MapFormat format, const Gaussians& gaussians,
                    const std::vector<std::string>& notes) {
  std::vector<std::string> lost;
  if (format == MapFormat::splat) {
    if (blend_order_from_lines(notes) == BlendOrder::distance)
      lost.emplace_back("that these Gaussians are sorted by distance (train --blend-order depth)");
    if (gaussians.sh_degree > 0) {
      lost.push_back("colour that depends on direction (harmonics of degree 1 to " +
                     std::to_string(gaussians.sh_degree) + ")");
    }
    if (!notes.empty()) lost.emplace_back("the header (model of sigma, places, quality, settings)");
  } else if (format == MapFormat::gltf && blend_order_from_lines(notes) == BlendOrder::depth) {
    lost.emplace_back("for other programs that these Gaussians are sorted by depth: its only order is distance");
  }
  if (lost.empty()) return;
  std::string line = lost[0];
  for (std::size_t i = 1; i < lost.size(); ++i) line += (i + 1 < lost.size() ? ", " : " and ") + lost[i];
  log_warning(path + ": " + format_name(format) + " cannot store " + line);
}

/// The comments of a header: the format's notes, then the lines of the map.
std::vector<std::string> header_lines(const std::vector<std::string>& notes) {
  std::vector<std::string> lines = format_notes;
  lines.insert(lines.end(), notes.begin(), notes.end());
  return lines;
}

/// Empty if it is no regular file or cannot be read.
std::string first_bytes(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};  // opening a FIFO would wait for its writer
  std::ifstream in(path, std::ios::binary);
  std::string bytes(4096, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// The meta.json of a folder in which SOG is not packed into an archive; else the path itself.
std::string file_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return path;
  const std::filesystem::path meta = std::filesystem::path(path) / "meta.json";
  return std::filesystem::is_regular_file(meta, error) ? meta.string() : path;
}

/// Reads files beside `path`, and no others.
ReadSibling siblings_of(const std::string& path) {
  return [path](const std::string& name) {
    const std::filesystem::path relative(name);
    const bool leads_out = std::any_of(relative.begin(), relative.end(), [](const auto& part) { return part == ".."; });
    if (name.empty() || relative.is_absolute() || leads_out || has_control_characters(name)) {
      throw InputError(path, quoted_word(name), "must be a file in the folder of the map");
    }
    return read_file((std::filesystem::path(path).parent_path() / relative).string(), max_data_bytes);
  };
}

Map map_from_bytes(const std::string& name, const std::string& bytes, MapFormat format, const ReadSibling& siblings) {
  if (format == MapFormat::ply) return map_from_ply(parse_ply(name, bytes));
  if (format == MapFormat::splat) return {parse_splat(name, bytes), {}};
  ForeignMap map = format == MapFormat::spz    ? parse_spz(name, bytes)
                   : format == MapFormat::gltf ? parse_gltf(name, bytes, siblings)
                                               : parse_sog(name, bytes, siblings);
  MapHeader header = header_of(name, map.lines);
  return {std::move(map.gaussians), std::move(header)};
}

/// The format of the content, as read_map reads it. InputError as read_map.
MapFormat required_format(const std::string& path, std::string_view bytes) {
  const std::optional<MapFormat> format = format_of_content(path, bytes);
  require_format_of_name(path, format);
  if (!format) refuse_foreign_format(path, bytes);
  return format.value_or(MapFormat::ply);  // whose reader says what is wrong
}

}  // namespace

bool is_splat_path(const std::string& path) { return format_of_name(path) == MapFormat::splat; }

bool is_map_file(const std::string& path) {
  const std::string file = file_of(path);
  const std::string start = first_bytes(file);
  const std::optional<MapFormat> format = format_of_content(file, start);
  if (format && format != MapFormat::ply) return true;
  const std::optional<MapFormat> by_name = format_of_name(path);
  if (!format)
    return by_name && by_name != MapFormat::ply &&
           !same_word(std::filesystem::path(path).filename().string(), "meta.json");
  std::ifstream in(file, std::ios::binary);
  for (const PlyHeaderElement& element : read_ply_header(file, in).elements) {
    if (!same_word(element.name, element_name)) continue;
    return std::any_of(element.properties.begin(), element.properties.end(), [](const PlyHeaderProperty& property) {
      return same_word(property.name, "f_dc_0") || same_word(property.name, "packed_position");
    });
  }
  return false;
}

Map read_map(const std::string& path) {
  const std::string file = file_of(path);
  const MapFormat format = required_format(file, first_bytes(file));
  warn_of_other_format(file, format);
  return near_origin(file, format == MapFormat::ply
                               ? map_from_ply(read_ply(file))
                               : map_from_bytes(file, read_file(file, max_data_bytes), format, siblings_of(file)));
}

Map parse_map(const std::string& name, const std::string& bytes) {
  return near_origin(name, map_from_bytes(name, bytes, required_format(name, bytes), [&name](const std::string& file) {
                       throw InputError(name, quoted_word(file), "is another file, which is not in memory");
                       return std::string();
                     }));
}

MapHeader read_map_header(const std::string& path) {
  const std::string file = file_of(path);
  const std::string start = first_bytes(file);
  if (start.empty()) read_file(file, max_data_bytes);  // throws with the reason why it cannot be read
  switch (required_format(file, start)) {
    case MapFormat::splat:
      return {};
    case MapFormat::spz:
      return header_of(file, spz_lines(file, read_file(file, max_data_bytes)));
    case MapFormat::gltf:
      return header_of(file, gltf_lines(file, read_file(file, max_data_bytes)));
    case MapFormat::sog:
      return header_of(file, sog_lines(file, read_file(file, max_data_bytes)));
    case MapFormat::ply:
      break;
  }
  std::ifstream in(file, std::ios::binary);
  return header_of(file, read_ply_header(file, in).comments);
}

std::uintmax_t map_file_size(const std::string& path) {
  const std::string file = file_of(path);
  if (file == path) return std::filesystem::file_size(file);
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

void write_map(const std::string& path, const Map& map) { write_map(path, map.gaussians, map.header.notes); }

void write_map(const std::string& path, const Gaussians& gaussians, const std::vector<std::string>& notes) {
  gaussians.check();
  if (gaussians.empty()) throw InputError(path, "there are no Gaussians to write");
  const MapFormat format = format_of_name(path).value_or(MapFormat::ply);
  if (same_word(std::filesystem::path(path).extension().string(), ".gltf")) {
    throw InputError(path, "glTF is written as one binary file, .glb");
  }
  warn_of_losses(path, format, gaussians, notes);
  switch (format) {
    case MapFormat::splat:
      return write_file_atomically(path, splat_bytes(gaussians));
    case MapFormat::spz:
      return write_file_atomically(path, spz_bytes(path, gaussians, header_lines(notes)));
    case MapFormat::gltf:
      return write_file_atomically(path, glb_bytes(path, gaussians, header_lines(notes)));
    case MapFormat::sog:
      throw InputError(path, "SOG is read, but not written");
    case MapFormat::ply:
      break;
  }
  Ply ply;
  ply.file = path;
  ply.comments = header_lines(notes);

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
