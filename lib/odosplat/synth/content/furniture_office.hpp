// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/random.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {

/// Office furniture and equipment, in their own frames as in furniture.hpp: z up, front towards -y, metres.

/// Desk of a size (width, depth, height): a top on a metal frame, a panel at its back, a box for cables.
void add_desk(SceneBuilder& builder, const Eigen::Vector3f& size, int top, int frame);

/// Swivel chair on five castors, 1.1 m high, facing -y.
void add_office_chair(SceneBuilder& builder, int cloth, int plastic, int metal);

/// Screen on a foot, its picture towards -y; `width` of the screen, 16 by 9.
void add_monitor(SceneBuilder& builder, float width, int screen, int plastic);

/// Keyboard, 0.44 x 0.14, and a mouse to the right of it.
void add_keyboard(SceneBuilder& builder, int keys, int plastic);

/// Lamp with an arm of two thin parts, `height` to its elbow, with its light.
void add_desk_lamp(SceneBuilder& builder, float height, int metal, int shade, const Eigen::Vector3f& radiance);

/// Cabinet of a size with `drawers` drawers with handles.
void add_drawers(SceneBuilder& builder, const Eigen::Vector3f& size, int drawers, int body, int front, int handle);

/// Board with a frame and a tray for pens, on the plane y = 0, centre at the origin.
void add_whiteboard(SceneBuilder& builder, float width, float height, int board, int frame, int pens);

/// Partition between desks, `width` x height, on two feet, centre at the origin.
void add_partition(SceneBuilder& builder, float width, float height, int cloth, int frame);

/// Light panel below the ceiling z = 0, with its light.
void add_ceiling_light(SceneBuilder& builder, const Eigen::Vector2f& size, int panel, int frame,
                       const Eigen::Vector3f& radiance);

/// Venetian blind on the plane y = 0, lower left corner at the origin, its slats turned by `tilt_deg`.
void add_blind(SceneBuilder& builder, float width, float height, float tilt_deg, int slat, int cord);

/// Cable of a radius along a smooth curve through the given points, which are in the local frame.
void add_cable(SceneBuilder& builder, const std::vector<Eigen::Vector3f>& points, float radius, int material);

/// Waste-paper bin, 0.3 high.
void add_bin(SceneBuilder& builder, int body, int paper);

/// Sheets of paper lying around the origin.
void add_papers(SceneBuilder& builder, int sheets, const std::vector<int>& pages, Random& random);

}  // namespace odosplat
