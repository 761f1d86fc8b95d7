// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/synth/scene.hpp"

namespace odosplat {

/// A small closed room for tests: x 0..4, y 0..3, z 0..2.5 m, every surface with a strong multi-scale texture of its
/// own, two boxes and a ball in it for occlusion. Unlit: colours do not depend on the view. About a tenth of a second.
Scene make_box_room(std::uint64_t seed);


}  // namespace odosplat
