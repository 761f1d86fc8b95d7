// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <initializer_list>

namespace odosplat::apps {

/// Help of a flag that takes a map of Gaussians.
inline constexpr const char* map_formats = "PLY, packed PLY, .splat, .spz, .glb, .gltf, .sog or its meta.json";

/// Extensions of the maps that are written.
inline constexpr std::initializer_list<const char*> map_extensions{".ply", ".splat", ".spz", ".glb"};

}  // namespace odosplat::apps
