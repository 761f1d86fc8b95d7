// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <filesystem>

namespace odosplat::apps_test {

/// Writes a sequence in TUM layout: `frames` images of 160x120 of a textured box room, with depth and true poses.
void write_tiny_sequence(const std::filesystem::path& folder, int frames);

}  // namespace odosplat::apps_test
