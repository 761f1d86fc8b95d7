// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/splat_file.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/format/quantized.hpp"

namespace odosplat {
namespace {

constexpr std::size_t record = 32;
constexpr float max_log_scale = 80.0F;  // as float can hold it

std::vector<std::size_t> largest_first(const Gaussians& gaussians) {
  std::vector<double> sizes(gaussians.size());  // logarithms, which do not overflow
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const float* scale = &gaussians.log_scales[3 * i];
    sizes[i] = double{scale[0]} + scale[1] + scale[2] - std::log1p(std::exp(-double{gaussians.opacity_logits[i]}));
  }
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  return order;
}

}  // namespace

Gaussians parse_splat(const std::string& name, const std::string& bytes) {
  if (bytes.empty()) throw InputError(name, "holds no Gaussians");
  if (bytes.size() % record != 0) {
    throw InputError(name, "has " + std::to_string(bytes.size()) + " bytes, no multiple of 32: cut off, or no .splat");
  }
  Gaussians g;
  g.resize(bytes.size() / record);
  BrokenRows broken(name, g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    const char* at = bytes.data() + i * record;
    for (std::size_t a = 0; a < 3; ++a) {
      g.positions[3 * i + a] = load_little<float>(at + 4 * a);
      const auto scale = load_little<float>(at + 12 + 4 * a);
      if (!std::isfinite(g.positions[3 * i + a])) broken.add(i, "its position is not finite");
      if (!(std::isfinite(scale) && scale >= 0.0F)) broken.add(i, "its scale is negative or not finite");
      g.log_scales[3 * i + a] = std::max(std::log(scale), zero_log_scale);
      g.sh[3 * i + a] = (byte_value(at[24 + a]) / 255.0F - 0.5F) / sh_constant;
    }
    g.opacity_logits[i] = logit_of_opacity_byte(byte_value(at[27]));
    Eigen::Map<Eigen::Vector4f> rotation(&g.rotations[4 * i]);
    for (std::size_t a = 0; a < 4; ++a) {
      rotation[static_cast<Eigen::Index>(a)] = (byte_value(at[28 + a]) - 128.0F) / 128.0F;
    }
    if (!rotation.isZero(0.0F)) rotation.normalize();
  }
  broken.leave_out(g);
  return g;
}

std::string splat_bytes(const Gaussians& gaussians) {
  const auto stride = 3 * static_cast<std::size_t>(gaussians.coefficients());
  std::string bytes;
  bytes.reserve(gaussians.size() * record);
  for (const std::size_t i : largest_first(gaussians)) {
    for (std::size_t a = 0; a < 3; ++a) append_little(bytes, gaussians.positions[3 * i + a]);
    for (std::size_t a = 0; a < 3; ++a) {
      append_little(bytes, std::exp(std::clamp(gaussians.log_scales[3 * i + a], zero_log_scale, max_log_scale)));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      append_little(bytes, rounded_byte(255.0F * (0.5F + sh_constant * gaussians.sh[stride * i + c])));
    }
    append_little(bytes, rounded_byte(255.0F * opacity_of_logit(gaussians.opacity_logits[i])));
    Eigen::Vector4f rotation = Eigen::Map<const Eigen::Vector4f>(&gaussians.rotations[4 * i]);
    rotation.stableNormalize();
    for (const float value : rotation) append_little(bytes, rounded_byte(128.0F * value + 128.0F));
  }
  return bytes;
}

}  // namespace odosplat
