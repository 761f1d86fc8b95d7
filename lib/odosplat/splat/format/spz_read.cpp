// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/archive/compression.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/format/quantized.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/format/spz_layout.hpp"
#include "odosplat/splat/format/turned.hpp"

namespace odosplat {
namespace {

using Widths = std::array<std::size_t, 6>;
using Streams = std::array<std::string, 6>;

struct SpzHeader {
  std::uint32_t version = 0;
  std::uint32_t count = 0;
  int degree = 0;
  int fraction_bits = 0;
  std::uint8_t flags = 0;
  std::uint8_t streams = 0;  // version 4 only
  std::size_t table = 0;

  Widths widths() const { return spz::widths(version, degree); }
};

SpzHeader checked_header(const std::string& name, const std::string& bytes, std::uint32_t least_version,
                         std::uint32_t most_version) {
  SpzHeader header;
  header.version = load_little<std::uint32_t>(&bytes[4]);
  header.count = load_little<std::uint32_t>(&bytes[8]);
  header.degree = static_cast<std::uint8_t>(bytes[12]);
  header.fraction_bits = static_cast<std::uint8_t>(bytes[13]);
  header.flags = static_cast<std::uint8_t>(bytes[14]);
  header.streams = static_cast<std::uint8_t>(bytes[15]);
  if (header.version < least_version || header.version > most_version) {
    throw InputError(name, "header",
                     "is SPZ of version " + std::to_string(header.version) + ", which is not read (1 to 4 are)");
  }
  if (header.degree > spz::most_degree) {
    throw InputError(name, "header", "has SH degree " + std::to_string(header.degree) + ", must be 0 to 4");
  }
  if (header.version > 1 && header.fraction_bits > 23) {
    throw InputError(name, "header",
                     "has " + std::to_string(header.fraction_bits) + " fractional bits, must be 0 to 23");
  }
  if (header.count == 0) throw InputError(name, "holds no Gaussians");
  return header;
}

std::uint64_t data_size(const SpzHeader& header) {
  const Widths widths = header.widths();
  return header.count * std::accumulate(widths.begin(), widths.end(), std::uint64_t{0});
}

/// The streams of versions 1 to 3.
std::pair<SpzHeader, Streams> read_gzip(const std::string& name, const std::string& bytes, bool header_alone) {
  GzipStream gzip(name, bytes);
  const std::string head = gzip.read(spz::gzip_header);
  if (!head.starts_with(spz::magic)) throw InputError(name, "is compressed (gzip), but is no SPZ: unpack it first");
  const SpzHeader header = checked_header(name, head, 1, 3);
  Streams streams;
  if (header_alone) return {header, streams};
  require_plausible_size(name, data_size(header), bytes.size());
  const Widths widths = header.widths();
  for (std::size_t s = 0; s < streams.size(); ++s) streams[s] = gzip.read(header.count * widths[s]);
  gzip.finish();
  return {header, std::move(streams)};
}

SpzHeader zstd_header(const std::string& name, const std::string& bytes) {
  if (bytes.size() < spz::zstd_header) throw InputError(name, "is cut off in the header of SPZ");
  SpzHeader header = checked_header(name, bytes, spz::latest_version, spz::latest_version);
  header.table = load_little<std::uint32_t>(&bytes[16]);
  if (header.table < spz::zstd_header || header.table > bytes.size() ||
      (bytes.size() - header.table) / spz::table_row < header.streams) {
    throw InputError(name, "header", "is cut off, or its table of streams is not where the header says");
  }
  return header;
}

/// The streams of version 4. Attributes without values may have no stream.
std::pair<SpzHeader, Streams> read_zstd(const std::string& name, const std::string& bytes) {
  const SpzHeader header = zstd_header(name, bytes);
  require_plausible_size(name, data_size(header), bytes.size());
  const Widths widths = header.widths();
  const auto wanted =
      static_cast<std::size_t>(std::count_if(widths.begin(), widths.end(), [](std::size_t w) { return w > 0; }));
  if (header.streams != wanted && header.streams != widths.size()) {
    throw InputError(name, "header",
                     "has " + std::to_string(header.streams) + " streams, must have " + std::to_string(wanted));
  }
  Streams streams;
  std::size_t at = header.table + header.streams * spz::table_row;
  for (std::size_t s = 0; s < header.streams; ++s) {
    const std::string place = "stream " + std::to_string(s);
    const char* row = &bytes[header.table + s * spz::table_row];
    const auto stored = load_little<std::uint64_t>(row);
    const std::uint64_t size = header.count * std::uint64_t{widths[s]};
    if (load_little<std::uint64_t>(row + 8) != size) {
      throw InputError(name, place,
                       "declares " + std::to_string(load_little<std::uint64_t>(row + 8)) + " bytes, must have " +
                           std::to_string(size) + " for " + std::to_string(header.count) + " Gaussians");
    }
    if (stored > bytes.size() - at) throw InputError(name, place, "is cut off");
    const std::string_view data = std::string_view(bytes).substr(at, stored);
    if (size > 0) streams[s] = zstd_decompressed(name, place, data, size);
    at += stored;
  }
  return {header, std::move(streams)};
}

/// The lines in the extension of ours; of other extensions nothing is read.
std::vector<std::string> extension_lines(const std::string& name, const std::string& bytes, const SpzHeader& header) {
  std::size_t at = spz::zstd_header;
  while ((header.flags & spz::extended) != 0 && header.table - at >= 8) {
    const auto type = load_little<std::uint32_t>(&bytes[at]);
    const std::size_t size = load_little<std::uint32_t>(&bytes[at + 4]);
    at += 8;
    if (size > header.table - at)
      throw InputError(name, "header", "is damaged: an extension is longer than the header");
    if (type == spz::lines_extension) return split_lines(bytes.substr(at, size));
    at += size;
  }
  return {};
}

std::vector<std::string> lines_of(const std::string& name, const std::string& bytes, const SpzHeader& header) {
  std::vector<std::string> lines;
  if (header.version == spz::latest_version) lines = extension_lines(name, bytes, header);
  if (lines.empty() && (header.flags & spz::antialiased) != 0) lines.emplace_back("compensated 1");
  return lines;
}

float half_value(const char* bytes) {
  const auto half = load_little<std::uint16_t>(bytes);
  const int exponent = (half >> 10) & 0x1F;
  const auto fraction = static_cast<float>(half & 0x3FF) / 1024.0F;
  float value = std::ldexp(exponent == 0 ? fraction : 1.0F + fraction, std::max(exponent, 1) - 15);
  if (exponent == 0x1F) value = fraction == 0.0F ? HUGE_VALF : NAN;
  return (half & 0x8000) != 0 ? -value : value;
}

float fixed_value(const char* bytes, int fraction_bits) {
  const auto byte = [bytes](std::size_t k) { return std::uint32_t{static_cast<std::uint8_t>(bytes[k])}; };
  const std::uint32_t left = byte(0) << 8U | byte(1) << 16U | byte(2) << 24U;  // the sign where int32 has it
  return std::ldexp(static_cast<float>(static_cast<std::int32_t>(left) >> 8), -fraction_bits);
}

/// x y z of versions 1 and 2, the three smallest later; to w x y z.
void decode_rotation(const char* bytes, std::uint32_t version, float* rotation) {
  std::array<float, 4> xyzw{};
  std::size_t largest = 3;
  if (version < 3) {
    for (std::size_t a = 0; a < 3; ++a) xyzw[a] = byte_value(bytes[a]) / 127.5F - 1.0F;
  } else {
    auto packed = load_little<std::uint32_t>(bytes);
    largest = packed >> 30U;
    for (std::size_t a = 4; a-- > 0;) {
      if (a == largest) continue;
      const float size = sqrt_half * static_cast<float>(packed & 0x1FFU) / static_cast<float>(spz::rotation_steps);
      xyzw[a] = (packed & 0x200U) != 0 ? -size : size;
      packed >>= 10U;
    }
  }
  restore_largest(xyzw.data(), largest);
  rotation[0] = xyzw[3];
  std::copy_n(xyzw.begin(), 3, rotation + 1);
}

Gaussians gaussians_of(const std::string& name, const SpzHeader& header, const Streams& streams) {
  const auto& [positions, alphas, colors, scales, rotations, harmonics] = streams;
  Gaussians g;
  g.sh_degree = std::min(header.degree, 3);
  g.resize(header.count);
  const Widths widths = header.widths();
  const std::size_t kept = 3 * static_cast<std::size_t>(g.coefficients() - 1);
  BrokenRows broken(name, g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    float* sh = &g.sh[(3 + kept) * i];
    for (std::size_t a = 0; a < 3; ++a) {
      float& position = g.positions[3 * i + a];
      position = header.version == 1 ? half_value(&positions[6 * i + 2 * a])
                                     : fixed_value(&positions[9 * i + 3 * a], header.fraction_bits);
      if (!std::isfinite(position)) broken.add(i, "its position is not finite");
      g.log_scales[3 * i + a] = byte_value(scales[3 * i + a]) / spz::scale_steps + spz::least_log_scale;
      sh[a] = (byte_value(colors[3 * i + a]) / 255.0F - 0.5F) / spz::color_scale;
    }
    for (std::size_t j = 0; j < kept; ++j) sh[3 + j] = byte_value(harmonics[widths[5] * i + j]) / spz::sh_steps - 1.0F;
    g.opacity_logits[i] = logit_of_opacity_byte(byte_value(alphas[i]));
    decode_rotation(&rotations[widths[4] * i], header.version, &g.rotations[4 * i]);
  }
  broken.leave_out(g);
  return g;
}

}  // namespace

ForeignMap parse_spz(const std::string& name, const std::string& bytes) {
  const bool is_latest = bytes.starts_with(spz::magic);
  const auto [header, streams] = is_latest ? read_zstd(name, bytes) : read_gzip(name, bytes, false);
  if (header.degree > 3) log_warning(name + ": harmonics of degree 4 are left out");
  ForeignMap map{gaussians_of(name, header, streams), lines_of(name, bytes, header)};
  turn_by_half(map.gaussians, Axis::x);
  return map;
}

std::vector<std::string> spz_lines(const std::string& name, const std::string& bytes) {
  const bool is_latest = bytes.starts_with(spz::magic);
  return lines_of(name, bytes, is_latest ? zstd_header(name, bytes) : read_gzip(name, bytes, true).first);
}

}  // namespace odosplat
