// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Decodes a lossless WebP image (RFC 9649), the exact values: channels R, G, B, alpha (255 where the image has none).
/// `name` stands for the file in errors. InputError: no WebP, lossy (values would not be exact), animated, more than
/// max_pixels (checked against the header before anything is decoded), damaged.
cv::Mat4b parse_lossless_webp(const std::string& name, const std::string& bytes, std::int64_t max_pixels);

}  // namespace odosplat
