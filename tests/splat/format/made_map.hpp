// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat::test {

/// Gaussians without any symmetry, in front of a camera at the origin, with values that every format can hold.
inline Gaussians made_gaussians(int degree, std::size_t count, std::uint64_t seed = 1) {
  Random random(seed);
  Gaussians g;
  g.sh_degree = degree;
  g.resize(count);
  const auto within = [&](double least, double most) {
    return static_cast<float>(least + (most - least) * random.uniform());
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::size_t a : {0U, 1U, 2U}) {
      g.positions[3 * i + a] = within(-0.8, 0.8) + (a == 2 ? 4.0F : 0.1F * static_cast<float>(a));
      g.log_scales[3 * i + a] = within(-4.0, -1.0);
    }
    Eigen::Map<Eigen::Vector4f> q(&g.rotations[4 * i]);
    for (float& v : q) v = static_cast<float>(random.normal());
    q.normalize();
    g.opacity_logits[i] = within(-2.0, 4.0);
  }
  const auto width = 3 * static_cast<std::size_t>(g.coefficients());
  for (std::size_t at = 0; at < g.sh.size(); ++at) g.sh[at] = at % width < 3 ? within(-1.5, 1.5) : within(-0.4, 0.4);
  return g;
}

inline double opacity(const Gaussians& g, std::size_t i) {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(g.opacity_logits[i])));
}

/// The most that a format may change.
struct Steps {
  double position = 0.0;   // [m]
  double log_scale = 0.0;  // [ln m]
  double opacity = 0.0;
  double color = 0.0;     // of the coefficient of degree 0
  double harmonic = 0.0;  // of the others
  double rotation = 0.0;  // of a component of the unit quaternion
};

/// Expects the same Gaussians, in the same order, within the steps.
inline void expect_near(const Gaussians& found, const Gaussians& wanted, const Steps& steps) {
  ASSERT_EQ(found.size(), wanted.size());
  ASSERT_EQ(found.sh_degree, wanted.sh_degree);
  const auto width = 3 * static_cast<std::size_t>(wanted.coefficients());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_NEAR(found.positions[3 * i + a], wanted.positions[3 * i + a], steps.position) << i;
      EXPECT_NEAR(found.log_scales[3 * i + a], wanted.log_scales[3 * i + a], steps.log_scale) << i;
    }
    EXPECT_NEAR(opacity(found, i), opacity(wanted, i), steps.opacity) << i;
    for (std::size_t j = 0; j < width; ++j) {
      EXPECT_NEAR(found.sh[width * i + j], wanted.sh[width * i + j], j < 3 ? steps.color : steps.harmonic) << i;
    }
    Eigen::Vector4f q = Eigen::Map<const Eigen::Vector4f>(&found.rotations[4 * i]);
    const Eigen::Vector4f p = Eigen::Map<const Eigen::Vector4f>(&wanted.rotations[4 * i]).normalized();
    EXPECT_NEAR(q.norm(), 1.0, 1e-5) << i;
    if (q.dot(p) < 0.0F) q = -q;
    EXPECT_LE((q - p).cwiseAbs().maxCoeff(), steps.rotation) << i;
  }
}

/// The error that a call throws; empty: none.
inline std::string fault_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return {};
}

template <typename T>
std::string little(T value) {
  std::string bytes;
  append_little(bytes, value);
  return bytes;
}

inline std::string bytes_of(const std::vector<int>& values) {
  std::string bytes;
  for (const int v : values) bytes.push_back(static_cast<char>(v));
  return bytes;
}

/// zlib's compression with the container that `window` stands for: 31 gzip, -15 none.
inline std::string deflated(const std::string& bytes, int window) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::string gzip(const std::string& bytes) { return deflated(bytes, 31); }

}  // namespace odosplat::test
