// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::fuzz {

/// Functions called by the fuzzers and by the replay of their corpus: any bytes must be read or refused with an
/// InputError of one line. Any other exception, and a result that breaks its contract, aborts the program.
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
void gaussians(const std::string& bytes);  // maps in every format; in gaussian_entries.cpp

}  // namespace odosplat::fuzz
