// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/web/packed_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "odosplat/io/little_endian.hpp"

namespace odosplat::apps {
namespace {

constexpr float thinnest = -7.0F;  // ln of the shortest over the longest axis that is stored

/// Spreads the low 10 bits so that two zeros follow each.
std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | v << 16U) & 0x030000ffU;
  v = (v | v << 8U) & 0x0300f00fU;
  v = (v | v << 4U) & 0x030c30c3U;
  return (v | v << 2U) & 0x09249249U;
}

/// The rows along a Z curve through the box that holds all but a hundredth of the positions at each side.
std::vector<std::size_t> in_curve_order(const Gaussians& gaussians, std::vector<std::size_t> rows) {
  std::array<float, 3> low{};
  std::array<float, 3> extent{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    values.reserve(rows.size());
    for (const std::size_t row : rows) values.push_back(gaussians.positions[3 * row + axis]);
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 100;
    low[axis] = values.empty() ? 0.0F : values[cut];
    extent[axis] = values.empty() ? 0.0F : values[values.size() - 1 - cut] - low[axis];
  }
  std::vector<std::pair<std::uint32_t, std::size_t>> keyed;
  keyed.reserve(rows.size());
  for (const std::size_t row : rows) {
    std::uint32_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float offset = gaussians.positions[3 * row + axis] - low[axis];
      const float share = extent[axis] > 0.0F ? std::clamp(offset / extent[axis], 0.0F, 1.0F) : 0.0F;
      key |= spread_bits(static_cast<std::uint32_t>(1023.0F * share)) << axis;
    }
    keyed.emplace_back(key, row);
  }
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < keyed.size(); ++i) rows[i] = keyed[i].second;
  return rows;
}

std::uint32_t packed_rotation(const float* wxyz) {
  Eigen::Vector4f q = Eigen::Map<const Eigen::Vector4f>(wxyz).normalized();
  Eigen::Index largest = 0;
  q.cwiseAbs().maxCoeff(&largest);
  if (q[largest] < 0.0F) q = -q;
  std::uint32_t packed = static_cast<std::uint32_t>(largest) << 30U;
  unsigned shift = 0;
  for (Eigen::Index k = 0; k < 4; ++k) {
    if (k == largest) continue;
    const float share = std::clamp(0.5F + 0.5F * std::numbers::sqrt2_v<float> * q[k], 0.0F, 1.0F);
    packed |= static_cast<std::uint32_t>(std::lround(1023.0F * share)) << shift;
    shift += 10U;
  }
  return packed;
}

/// Values of one channel, N of them, quantised chunk by chunk.
struct QuantisedChannel {
  std::vector<float> ranges;          // low, high per chunk
  std::vector<std::uint32_t> values;  // 0 .. steps
};

QuantisedChannel quantised(const std::vector<float>& values, std::uint32_t steps) {
  QuantisedChannel result;
  result.values.reserve(values.size());
  for (std::size_t begin = 0; begin < values.size(); begin += PackedMap::chunk) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = values.begin() + static_cast<std::ptrdiff_t>(std::min(begin + PackedMap::chunk, values.size()));
    const auto [low, high] = std::minmax_element(first, last);
    result.ranges.insert(result.ranges.end(), {*low, *high});
    const double extent = static_cast<double>(*high) - static_cast<double>(*low);
    for (auto value = first; value != last; ++value) {
      const double share = extent > 0.0 ? (static_cast<double>(*value) - static_cast<double>(*low)) / extent : 0.0;
      result.values.push_back(static_cast<std::uint32_t>(std::lround(share * steps)));
    }
  }
  return result;
}

/// The channels of PackedMap before they are quantised.
std::vector<std::vector<float>> channels_of(const Gaussians& gaussians, const std::vector<std::size_t>& rows,
                                            int sh_degree) {
  const std::size_t colors = 3 * static_cast<std::size_t>(sh_coefficients(sh_degree));
  const std::size_t stride = 3 * static_cast<std::size_t>(gaussians.coefficients());
  std::vector<std::vector<float>> channels(6 + colors);
  for (std::vector<float>& channel : channels) channel.reserve(rows.size());
  for (const std::size_t row : rows) {
    for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(gaussians.positions[3 * row + c]);
    const float* log_scales = &gaussians.log_scales[3 * row];
    const float least = *std::max_element(log_scales, log_scales + 3) + thinnest;
    for (std::size_t c = 0; c < 3; ++c) channels[3 + c].push_back(std::max(log_scales[c], least));
    for (std::size_t c = 0; c < colors; ++c) channels[6 + c].push_back(gaussians.sh[stride * row + c]);
  }
  return channels;
}

}  // namespace

PackedMap pack_map(const Gaussians& gaussians, const std::vector<std::size_t>& rows, int sh_degree) {
  PackedMap packed;
  packed.count = rows.size();
  packed.sh_degree = std::min(sh_degree, gaussians.sh_degree);
  const std::vector<std::size_t> ordered = in_curve_order(gaussians, rows);
  std::vector<QuantisedChannel> channels;
  for (const std::vector<float>& values : channels_of(gaussians, ordered, packed.sh_degree)) {
    channels.push_back(quantised(values, channels.size() < 3 ? 0xffffU : 0xffU));
  }
  const std::size_t chunks = (rows.size() + PackedMap::chunk - 1) / PackedMap::chunk;
  for (std::size_t k = 0; k < chunks; ++k) {
    for (const QuantisedChannel& channel : channels) {
      append_little(packed.bytes, channel.ranges[2 * k]);
      append_little(packed.bytes, channel.ranges[2 * k + 1]);
    }
  }
  for (const std::size_t row : ordered) append_little(packed.bytes, packed_rotation(&gaussians.rotations[4 * row]));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    for (const std::uint32_t value : channels[c].values) {
      if (c < 3) {
        append_little(packed.bytes, static_cast<std::uint16_t>(value));
      } else {
        packed.bytes += static_cast<char>(value);
      }
    }
  }
  for (const std::size_t row : ordered) {
    const double opacity = 1.0 / (1.0 + std::exp(-static_cast<double>(gaussians.opacity_logits[row])));
    packed.bytes += static_cast<char>(std::lround(255.0 * opacity));
  }
  return packed;
}

}  // namespace odosplat::apps
