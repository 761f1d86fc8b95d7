// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/io/archive/compression.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/splat/format/quantized.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/format/spz_layout.hpp"
#include "odosplat/splat/format/turned.hpp"
#include "odosplat/splat/map_header.hpp"

namespace odosplat {
namespace {

constexpr int usual_fraction_bits = 12;  // what other writers use: steps of 0.24 mm
constexpr int most_fraction_bits = 23;
constexpr int extent_bits = 15;  // a map has 2^14 steps at least from the origin to its farthest coordinate
constexpr float largest_fixed = 8388607.0F;

int fraction_bits_of(const std::string& name, const Gaussians& gaussians) {
  float most = 0.0F;
  for (const float position : gaussians.positions) most = std::max(most, std::abs(position));
  if (most > 0.5F * largest_fixed) throw InputError(name, "a coordinate is above 4e6 m, which SPZ cannot store");
  int exponent = 0;  // most < 2^exponent
  std::frexp(most, &exponent);
  const int wanted = most > 0.0F ? std::max(usual_fraction_bits, extent_bits - exponent) : usual_fraction_bits;
  // The farthest coordinate has 23 bits; a rounding up to 2^23 is clamped.
  return std::min({wanted, most_fraction_bits, most_fraction_bits - exponent});
}

void append_fixed(std::string& bytes, float value, int fraction_bits) {
  const float steps = std::clamp(std::ldexp(value, fraction_bits), -largest_fixed, largest_fixed);
  const auto fixed = static_cast<std::uint32_t>(std::lround(steps));
  for (const unsigned shift : {0U, 8U, 16U}) bytes.push_back(static_cast<char>((fixed >> shift) & 0xFFU));
}

/// The three smallest of x y z w, the first in the highest bits.
std::uint32_t packed_rotation(const float* wxyz) {
  Eigen::Vector4f q(wxyz[1], wxyz[2], wxyz[3], wxyz[0]);
  q.stableNormalize();
  Eigen::Index largest = 0;
  q.cwiseAbs().maxCoeff(&largest);
  if (q[largest] < 0.0F) q = -q;
  auto packed = static_cast<std::uint32_t>(largest);
  for (Eigen::Index a = 0; a < 4; ++a) {
    if (a == largest) continue;
    const float steps = std::abs(q[a]) / sqrt_half * static_cast<float>(spz::rotation_steps);
    const auto size = std::min(static_cast<std::uint32_t>(std::lround(steps)), spz::rotation_steps);
    packed = packed << 10U | (q[a] < 0.0F ? 0x200U : 0U) | size;
  }
  return packed;
}

std::array<std::string, 6> packed_streams(const Gaussians& g, int fraction_bits) {
  std::array<std::string, 6> streams;
  auto& [positions, alphas, colors, scales, rotations, harmonics] = streams;
  const std::array<std::size_t, 6> widths = spz::widths(spz::latest_version, g.sh_degree);
  for (std::size_t s = 0; s < streams.size(); ++s) streams[s].reserve(widths[s] * g.size());
  const auto add = [](std::string& to, float value) { to.push_back(static_cast<char>(rounded_byte(value))); };
  for (std::size_t i = 0; i < g.size(); ++i) {
    const float* sh = &g.sh[(3 + widths[5]) * i];
    for (std::size_t a = 0; a < 3; ++a) {
      append_fixed(positions, g.positions[3 * i + a], fraction_bits);
      add(colors, 255.0F * (0.5F + spz::color_scale * sh[a]));
      add(scales, spz::scale_steps * (g.log_scales[3 * i + a] - spz::least_log_scale));
    }
    add(alphas, 255.0F * opacity_of_logit(g.opacity_logits[i]));
    append_little(rotations, packed_rotation(&g.rotations[4 * i]));
    for (std::size_t j = 0; j < widths[5]; ++j) add(harmonics, spz::sh_steps * (sh[3 + j] + 1.0F));
  }
  return streams;
}

}  // namespace

std::string spz_bytes(const std::string& name, Gaussians gaussians, const std::vector<std::string>& lines) {
  if (gaussians.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(name, "there are more Gaussians than SPZ can count");
  }
  turn_by_half(gaussians, Axis::x);
  const int fraction_bits = fraction_bits_of(name, gaussians);
  const std::array<std::string, 6> streams = packed_streams(gaussians, fraction_bits);
  const int used = gaussians.sh_degree > 0 ? 6 : 5;
  std::array<std::string, 6> compressed;
  parallel_for(used, 1, [&](int begin, int end) {
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s) {
      compressed[s] = zstd_compressed(streams[s]);
    }
  });

  const std::string text = joined_lines(lines);
  const bool is_compensated = map_header_number(lines, "compensated").value_or(0.0) != 0.0;
  std::string bytes(spz::magic);
  append_little(bytes, spz::latest_version);
  append_little(bytes, static_cast<std::uint32_t>(gaussians.size()));
  append_little(bytes, static_cast<std::uint8_t>(gaussians.sh_degree));
  append_little(bytes, static_cast<std::uint8_t>(fraction_bits));
  append_little(bytes, static_cast<std::uint8_t>((is_compensated ? spz::antialiased : 0U) |
                                                 (text.empty() ? 0U : unsigned{spz::extended})));
  append_little(bytes, static_cast<std::uint8_t>(used));
  append_little(bytes, static_cast<std::uint32_t>(spz::zstd_header + (text.empty() ? 0 : 8 + text.size())));
  bytes.resize(spz::zstd_header, '\0');
  if (!text.empty()) {
    append_little(bytes, spz::lines_extension);
    append_little(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
  }
  for (std::size_t s = 0; s < static_cast<std::size_t>(used); ++s) {
    append_little(bytes, std::uint64_t{compressed[s].size()});
    append_little(bytes, std::uint64_t{streams[s].size()});
  }
  for (const std::string& stream : compressed) bytes += stream;
  return bytes;
}

}  // namespace odosplat
