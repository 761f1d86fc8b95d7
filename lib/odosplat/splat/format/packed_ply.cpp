// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/packed_ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/format/quantized.hpp"

namespace odosplat {
namespace {

constexpr std::size_t chunk_size = 256;  // Gaussians a chunk
constexpr float sh_range = 8.0F;         // of the harmonics' bytes, -4..4
const std::string packed_element = "vertex";
const std::string chunk_element = "chunk";
const std::string sh_element = "sh";

/// Least and largest values of three quantities, chunk after chunk.
struct ChunkRange {
  std::array<std::vector<float>, 3> least;
  std::array<std::vector<float>, 3> most;

  /// A share of the range of a chunk.
  float at(std::size_t axis, std::size_t chunk, float share) const {
    return least[axis][chunk] + (most[axis][chunk] - least[axis][chunk]) * share;
  }
};

ChunkRange range_of(const Ply& ply, const std::string& kind, const std::array<const char*, 3>& axes) {
  ChunkRange range;
  for (std::size_t a = 0; a < 3; ++a) {
    range.least[a] = ply.column<float>(chunk_element, "min_" + kind + axes[a]);
    range.most[a] = ply.column<float>(chunk_element, "max_" + kind + axes[a]);
  }
  return range;
}

/// Fields of 11, 10 and 11 bits as shares of their range.
std::array<float, 3> shares(std::uint32_t word) {
  return {static_cast<float>(word >> 21U) / 2047.0F, static_cast<float>((word >> 11U) & 0x3FFU) / 1023.0F,
          static_cast<float>(word & 0x7FFU) / 2047.0F};
}

void unpack_rotation(std::uint32_t word, float* wxyz) {
  const std::size_t largest = word >> 30U;
  unsigned shift = 20;
  for (std::size_t a = 0; a < 4; ++a) {
    if (a == largest) continue;
    wxyz[a] = sqrt_half * (2.0F * static_cast<float>((word >> shift) & 0x3FFU) / 1023.0F - 1.0F);
    shift -= 10;
  }
  restore_largest(wxyz, largest);
}

/// The middle of a byte's step; the first and the last stand for the ends of the range.
float harmonic_of(std::uint8_t byte) {
  const float share = byte == 0 ? 0.0F : byte == 255 ? 1.0F : (static_cast<float>(byte) + 0.5F) / 256.0F;
  return sh_range * (share - 0.5F);
}

/// A column that must be of type T, as its bits are unpacked. type: PLY's name of it.
template <typename T>
std::vector<T> packed_column(const Ply& ply, const std::string& element, const std::string& property,
                             const char* type) {
  const PlyColumn* column = ply.element(element).find(property);
  if (column != nullptr && !std::holds_alternative<std::vector<T>>(*column)) {
    throw InputError(ply.file, element, property + " must be of type " + type);
  }
  return ply.column<T>(element, property);
}

void unpack_harmonics(const Ply& ply, Gaussians& g) {
  if (!ply.has(sh_element)) return;
  const PlyElement& element = ply.element(sh_element);
  const auto is_whole = [&](std::size_t count) {
    return element.has("f_rest_" + std::to_string(count - 1)) && !element.has("f_rest_" + std::to_string(count));
  };
  for (int degree = 1; degree <= 3 && g.sh_degree == 0; ++degree) {
    if (is_whole(3 * static_cast<std::size_t>(sh_coefficients(degree) - 1))) g.sh_degree = degree;
  }
  if (g.sh_degree == 0) {
    throw InputError(ply.file, sh_element, "must have 9, 24 or 45 properties f_rest_* (SH degree 1 to 3)");
  }
  if (element.count != g.size()) {
    throw InputError(ply.file, sh_element,
                     "has " + std::to_string(element.count) + " rows, must have " + std::to_string(g.size()));
  }
  const auto k = static_cast<std::size_t>(g.coefficients());
  std::vector<float> sh(3 * k * g.size());
  for (std::size_t i = 0; i < g.size(); ++i) std::copy_n(&g.sh[3 * i], 3, &sh[3 * k * i]);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t j = 1; j < k; ++j) {
      const std::vector<std::uint8_t> column =
          packed_column<std::uint8_t>(ply, sh_element, "f_rest_" + std::to_string(c * (k - 1) + j - 1), "uchar");
      for (std::size_t i = 0; i < g.size(); ++i) sh[3 * (k * i + j) + c] = harmonic_of(column[i]);
    }
  }
  g.sh = std::move(sh);
}

}  // namespace

bool is_packed_ply(const Ply& ply) {
  return ply.has(packed_element) && ply.element(packed_element).has("packed_position");
}

Gaussians gaussians_from_packed_ply(const Ply& ply) {
  const auto word = [&](const char* name) { return packed_column<std::uint32_t>(ply, packed_element, name, "uint"); };
  const std::vector<std::uint32_t> positions = word("packed_position");
  const std::vector<std::uint32_t> rotations = word("packed_rotation");
  const std::vector<std::uint32_t> scales = word("packed_scale");
  const std::vector<std::uint32_t> colors = word("packed_color");
  if (positions.empty()) throw InputError(ply.file, "holds no Gaussians");
  const PlyElement& chunks = ply.element(chunk_element);
  if (chunks.count != (positions.size() + chunk_size - 1) / chunk_size) {
    throw InputError(ply.file, chunk_element,
                     "has " + std::to_string(chunks.count) + " rows, must have one for 256 of the " +
                         std::to_string(positions.size()) + " Gaussians each");
  }
  constexpr std::array<const char*, 3> xyz{"x", "y", "z"};
  constexpr std::array<const char*, 3> rgb{"r", "g", "b"};
  const ChunkRange places = range_of(ply, "", xyz);
  const ChunkRange sizes = range_of(ply, "scale_", xyz);
  const bool has_color_range = chunks.has("min_r");  // since SuperSplat 2
  const ChunkRange tints = has_color_range ? range_of(ply, "", rgb) : ChunkRange{};

  Gaussians g;
  g.resize(positions.size());
  BrokenRows broken(ply.file, g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    const std::size_t chunk = i / chunk_size;
    const std::array<float, 3> place = shares(positions[i]);
    const std::array<float, 3> size = shares(scales[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      const float share = static_cast<float>((colors[i] >> (24U - 8U * static_cast<unsigned>(a))) & 0xFFU) / 255.0F;
      const float tint = has_color_range ? tints.at(a, chunk, share) : share;
      g.positions[3 * i + a] = places.at(a, chunk, place[a]);
      g.log_scales[3 * i + a] = sizes.at(a, chunk, size[a]);
      g.sh[3 * i + a] = (tint - 0.5F) / sh_constant;
      if (!std::isfinite(g.positions[3 * i + a])) broken.add(i, "its position is not finite");
      if (!std::isfinite(g.log_scales[3 * i + a])) broken.add(i, "its scale is not finite");
      if (!std::isfinite(g.sh[3 * i + a])) broken.add(i, "its colour is not finite");
    }
    unpack_rotation(rotations[i], &g.rotations[4 * i]);
    g.opacity_logits[i] = logit_of_opacity_byte(static_cast<float>(colors[i] & 0xFFU));
  }
  unpack_harmonics(ply, g);
  broken.leave_out(g);
  return g;
}

}  // namespace odosplat
