// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "odosplat/core/random.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {

/// Furniture in its own frame: z up, standing on z = 0 around the origin unless stated otherwise, front towards -y.
/// Metres. Each function adds to the builder in the frame set by builder.place(); materials are indices of the
/// builder's materials.

/// A uniform random number between two limits, in single precision.
inline float between(Random& random, double low, double high) { return static_cast<float>(random.uniform(low, high)); }

/// Frame at (x, y, z), rotated by `degrees` about z (counter-clockwise from above).
Eigen::Isometry3f standing_at(float x, float y, float z, float degrees);

/// Table of a size (width, depth, height) with four square legs, set in from the edge.
void add_table(SceneBuilder& builder, const Eigen::Vector3f& size, float top_thickness, float leg, int top, int legs);

/// Chair with round legs and a slatted back, 0.44 x 0.46 x 0.92.
void add_chair(SceneBuilder& builder, int wood, int seat);

/// Sofa, `width` x 0.92 x 0.82, back along y = +0.46, with seat and back cushions and two pillows.
void add_sofa(SceneBuilder& builder, float width, int cloth, int pillow_a, int pillow_b);

/// Shelf of a size with `boards` levels: the lower `doors` of them have doors, the others are filled with books (cover
/// materials picked at random, with gaps), back along y = +depth/2.
void add_bookshelf(SceneBuilder& builder, const Eigen::Vector3f& size, int boards, int doors, int wood,
                   const std::vector<int>& books, int paper, Random& random);

/// Cupboard with doors and legs, back along y = +depth/2.
void add_sideboard(SceneBuilder& builder, const Eigen::Vector3f& size, int wood, int front, int knobs);

/// Framed picture on the plane y = 0, centre at the origin, seen from -y.
void add_picture(SceneBuilder& builder, float width, float height, float frame, int picture, int frame_material);

/// Plant in a pot with arching leaves, about `height` high; the leaves extend sideways by up to 0.3 of that.
void add_plant(SceneBuilder& builder, float height, int leaves, int pot, int leaf, int earth, Random& random);

/// Lamp on a pole, 1.6 m high, with its light.
void add_floor_lamp(SceneBuilder& builder, int metal, int shade, const Eigen::Vector3f& radiance);

/// Window in a hole of the wall y = 0 whose inside is at -y: lower left corner of the hole at the origin, reveal of
/// `depth`, frame with a crossbar, sill; it is a light source (daylight).
void add_window(SceneBuilder& builder, float width, float height, float depth, int wall, int frame,
                const Eigen::Vector3f& radiance);

/// Curtain in folds, hanging from z = height to 0.05 at y = 0, `width` wide, centred.
void add_curtain(SceneBuilder& builder, float width, float height, int folds, int cloth);

/// Radiator below a window, `width` x 0.55 high, on the wall y = 0.
void add_radiator(SceneBuilder& builder, float width, int metal);

/// A few objects for a table top, around the origin at z = 0: a stack of books, a bowl and a mug.
void add_tableware(SceneBuilder& builder, const std::vector<int>& books, int paper, int bowl, int mug, Random& random);

/// Television on its foot, 16 by 9.
void add_television(SceneBuilder& builder, float width, int screen, int body);

/// Vase with seven flowers of two colours, 0.5 high.
void add_flowers(SceneBuilder& builder, int vase, int stalk, int bloom_a, int bloom_b, Random& random);

/// Round clock on the wall y = 0, centre at the origin.
void add_clock(SceneBuilder& builder, float radius, int face, int hands);

/// Closed door with its frame on the wall y = 0, the middle of its foot at the origin.
void add_door(SceneBuilder& builder, float width, float height, int leaf, int frame, int handle);

}  // namespace odosplat
