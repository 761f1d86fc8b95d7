// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Stored colour value (0..1, as in image files) to linear light and back, with an exponent of 2.2.
float to_linear(float stored);
float from_linear(float linear);

/// A colour image on a surface, filtered by a mip pyramid (Williams 1983, trilinear) to avoid aliasing at a distance.
/// Coordinates are in tiles: (0,0) is the image's top-left corner, (1,1) its bottom-right corner. Outside, the image is
/// repeated or its border pixels are continued. Immutable; any number of threads may read it.
class Texture {
 public:
  enum class Edge { repeat, clamp };

  /// image: stored values 0..1, kept in 8 bits. size_m: width and height of one tile on a surface [m], > 0.
  /// Throws InputError for an empty image or a size that is not positive.
  Texture(const ColorImage& image, const Eigen::Vector2f& size_m, Edge edge);

  /// Linear R, G, B at uv [tiles], averaged over about `footprint` [texels of the finest level].
  Eigen::Vector3f sample(const Eigen::Vector2f& uv, float footprint) const;

  const Eigen::Vector2f& size_m() const { return size_m_; }
  /// Texels of the finest level per tile, in u and v.
  Eigen::Vector2f texels() const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::array<std::uint8_t, 4>> texels;
  };
  Eigen::Vector3f bilinear(const Level& level, const Eigen::Vector2f& uv) const;

  Eigen::Vector2f size_m_;
  Edge edge_;
  std::vector<Level> levels_;
};

}  // namespace odosplat
