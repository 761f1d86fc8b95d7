// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Images for textures, stored colours 0..1. All are determined by their seed. Those marked "Tiles" repeat without a
/// seam in both directions. Sizes in pixels, at least 1.

/// width x height image of color(x, y) with x, y in [0, 1) at pixel centres; clamped to 0..1. Runs on all threads.
ColorImage paint(int width, int height, const std::function<Eigen::Vector3f(float x, float y)>& color);

/// cells x cells squares of two colours. Tiles if cells is even.
ColorImage checker_pattern(int size, int cells, const Eigen::Vector3f& dark, const Eigen::Vector3f& bright);

/// Strong contrasts at all scales, for tests: fractal noise between three colours. cells: of the coarsest scale. Tiles.
ColorImage marble_pattern(int size, int cells, const Eigen::Vector3f& low, const Eigen::Vector3f& middle,
                          const Eigen::Vector3f& high, std::uint32_t seed);

/// Wood with grain along x, two tones. Tiles.
ColorImage wood_pattern(int width, int height, const Eigen::Vector3f& dark, const Eigen::Vector3f& bright,
                        std::uint32_t seed);

/// A floor of planks along x with individual tone, grain and joints. Tiles.
ColorImage plank_pattern(int size, int planks, const Eigen::Vector3f& dark, const Eigen::Vector3f& bright,
                         std::uint32_t seed);

/// Painted plaster: one colour with faint unevenness. contrast: half the range of brightness, as a share of the
/// colour. Tiles.
ColorImage plaster_pattern(int size, const Eigen::Vector3f& color, float contrast, std::uint32_t seed);

/// Bricks in stretcher bond, rows of them in an even number. Tiles.
ColorImage brick_pattern(int width, int height, int columns, int rows, std::uint32_t seed);

/// Woven cloth; stripes > 0 adds that many stripes of the second colour across x. Tiles.
ColorImage cloth_pattern(int size, const Eigen::Vector3f& color, const Eigen::Vector3f& stripe, int stripes,
                         std::uint32_t seed);

/// An oriental carpet: border, field with a medallion and small motifs, pile noise. Does not tile.
ColorImage carpet_pattern(int width, int height, std::uint32_t seed);

/// A picture with large and small detail. kind: 0 landscape, 1 town, 2 abstract; other values are taken modulo 3. Does
/// not tile.
ColorImage picture_pattern(int width, int height, int kind, std::uint32_t seed);

/// A book's spine with bands and lines like lettering, in greys that are multiplied by a tint. Does not tile.
ColorImage book_pattern(int width, int height, std::uint32_t seed);

/// Carpet tiles whose pile runs alternately along x and y. Tiles if `tiles` is even.
ColorImage carpet_tile_pattern(int size, int tiles, const Eigen::Vector3f& color, float contrast, std::uint32_t seed);

/// A suspended ceiling of mineral tiles in rails. Tiles.
ColorImage ceiling_tile_pattern(int size, int tiles, const Eigen::Vector3f& color, const Eigen::Vector3f& rail,
                                std::uint32_t seed);

/// Keys of a keyboard. Does not tile.
ColorImage keyboard_pattern(int width, int height, const Eigen::Vector3f& body, const Eigen::Vector3f& keys);

/// A computer's screen with two windows of text, a printed page, a whiteboard with boxes and writing. None tiles.
ColorImage screen_pattern(int width, int height, std::uint32_t seed);
ColorImage document_pattern(int width, int height, std::uint32_t seed);
ColorImage whiteboard_pattern(int width, int height, std::uint32_t seed);

/// The view from a window over azimuth (x) and elevation (y, zenith on top): sky with clouds and a line of trees. Tiles
/// in x.
ColorImage outdoor_pattern(int width, int height, std::uint32_t seed);

}  // namespace odosplat
