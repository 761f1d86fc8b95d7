// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/webp_image.hpp"

#include <cstddef>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/io/image/quiet_opencv.hpp"
#include "odosplat/io/little_endian.hpp"

namespace odosplat {
namespace {

constexpr std::size_t riff_header = 12;   // "RIFF", size, "WEBP"
constexpr std::size_t chunk_header = 8;   // name, size
constexpr std::size_t lossless_head = 5;  // the mark 0x2f; 14 bits each of width - 1 and height - 1
constexpr char lossless_mark = 0x2f;
constexpr std::size_t least_decoded = 32;

/// Width and height of the first lossless picture.
cv::Size lossless_size(const std::string& name, const std::string& bytes) {
  const std::string_view all = bytes;
  if (all.size() < riff_header || !all.starts_with("RIFF") || all.substr(8, 4) != "WEBP") {
    throw InputError(name, "is no WebP image");
  }
  for (std::size_t at = riff_header; all.size() - at >= chunk_header;) {
    const std::string_view chunk = all.substr(at, 4);
    const std::size_t size = load_little<std::uint32_t>(&bytes[at + 4]);
    at += chunk_header;
    if (chunk == "ANIM" || chunk == "ANMF") throw InputError(name, "is an animated WebP image");
    if (chunk == "VP8 ") throw InputError(name, "is a lossy WebP image, must be lossless: its values are not exact");
    if (chunk == "VP8L") {
      if (all.size() - at < lossless_head || all[at] != lossless_mark) break;
      const auto sizes = load_little<std::uint32_t>(&bytes[at + 1]);
      return {static_cast<int>(sizes & 0x3FFFU) + 1, static_cast<int>((sizes >> 14U) & 0x3FFFU) + 1};
    }
    const std::size_t padded = size + size % 2;
    if (padded > all.size() - at) break;
    at += padded;
  }
  throw InputError(name, "is a damaged WebP image");
}

}  // namespace

cv::Mat4b parse_lossless_webp(const std::string& name, const std::string& bytes, std::int64_t max_pixels) {
  const cv::Size size = lossless_size(name, bytes);
  if (std::int64_t{size.width} * size.height > max_pixels) {
    throw InputError(name, "is " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                               ", must have at most " + std::to_string(max_pixels) + " pixels");
  }
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw InputError(name, "is too large");
  const QuietOpenCv quiet;
  // For files below 32 bytes OpenCV prints an error of its own; what follows an image is not read.
  std::string padded;
  if (bytes.size() < least_decoded) {
    padded = bytes;
    padded.resize(least_decoded, '\0');
  }
  const std::string& source = padded.empty() ? bytes : padded;
  const cv::Mat data(1, static_cast<int>(source.size()), CV_8U, const_cast<char*>(source.data()));
  cv::Mat image;
  try {
    image = cv::imdecode(data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.size() != size || image.depth() != CV_8U) throw InputError(name, "is a damaged WebP image");
  cv::Mat4b rgba;
  if (image.channels() == 4) {
    cv::cvtColor(image, rgba, cv::COLOR_BGRA2RGBA);
  } else if (image.channels() == 3) {
    cv::cvtColor(image, rgba, cv::COLOR_BGR2RGBA);
  } else {
    throw InputError(name, "is a damaged WebP image");
  }
  return rgba;
}

}  // namespace odosplat
