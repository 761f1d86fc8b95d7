// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::fuzz {

/// What the fuzzers and the replay of their corpus call: any bytes are read or refused with an InputError of one line;
/// any other exception, and a result that breaks its contract, ends the program.
void image(const std::string& bytes);
void ply(const std::string& bytes);
void trajectory(const std::string& bytes);
void camera_file(const std::string& bytes);
void sequence_lists(const std::string& bytes);
void colmap_text(const std::string& bytes);
void colmap_binary(const std::string& bytes);
void transforms(const std::string& bytes);
void pcd(const std::string& bytes);
void las(const std::string& bytes);
void cloud_text(const std::string& bytes);
void gaussians(const std::string& bytes);  // .splat and PLY; in gaussian_entries.cpp

}  // namespace odosplat::fuzz
