// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace odosplat::test {

inline std::string encoded(const std::string& extension, const cv::Mat& image, const std::vector<int>& flags = {}) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, flags);
  return {bytes.begin(), bytes.end()};
}

/// CRC-32 as defined for PNG, computed bit by bit.
inline std::uint32_t png_checksum(const std::string& bytes) {
  std::uint32_t c = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
  }
  return c ^ 0xFFFFFFFFU;
}

inline void put_big_endian(std::string& bytes, std::size_t at, std::uint32_t value, int n) {
  for (int i = 0; i < n; ++i) {
    bytes[at + static_cast<std::size_t>(i)] = static_cast<char>((value >> (8 * (n - 1 - i))) & 0xFFU);
  }
}

/// The PNG with another size in its header and a matching checksum; the pixels are unchanged.
inline std::string png_claiming(std::string png, int width, int height) {
  put_big_endian(png, 16, static_cast<std::uint32_t>(width), 4);
  put_big_endian(png, 20, static_cast<std::uint32_t>(height), 4);
  put_big_endian(png, 29, png_checksum(png.substr(12, 17)), 4);
  return png;
}

/// The same for a baseline JPEG.
inline std::string jpeg_claiming(std::string jpeg, int width, int height) {
  const std::size_t header = jpeg.find("\xff\xc0");
  put_big_endian(jpeg, header + 5, static_cast<std::uint32_t>(height), 2);
  put_big_endian(jpeg, header + 7, static_cast<std::uint32_t>(width), 2);
  return jpeg;
}

}  // namespace odosplat::test
