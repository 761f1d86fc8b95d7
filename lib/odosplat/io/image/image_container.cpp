// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/image_container.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr std::string_view png_signature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view jpeg_signature("\xff\xd8\xff", 3);
constexpr int max_side = 32768;
// Of a progressive JPEG: every scan decodes the whole image anew, in 20 bytes of the file; encoders write about 10.
constexpr int max_scans = 500;

std::uint32_t big_endian(std::string_view bytes, std::size_t at, std::size_t n) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < n; ++i) value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

[[noreturn]] void truncated(const std::string& name) { throw InputError(name, "is truncated"); }
[[noreturn]] void damaged(const std::string& name) { throw InputError(name, "is damaged"); }

void check_size(const std::string& name, const ImageContainer& image) {
  if (image.width < 1 || image.height < 1 || image.width > max_side || image.height > max_side) {
    throw InputError(name, "has a size out of range");
  }
}

struct Chunk {
  std::string_view type;
  std::string_view data;
  std::string_view whole;  // with length and checksum

  bool is_intact() const {  // the checksum is of type and data
    const auto* type_and_data = reinterpret_cast<const Bytef*>(type.data());
    return crc32_z(0, type_and_data, type.size() + data.size()) == big_endian(whole, whole.size() - 4, 4);
  }
};

// at: offset of a chunk whose length field and checksum lie within bytes, or an empty type if they do not.
Chunk chunk_at(std::string_view bytes, std::size_t at) {
  constexpr std::size_t frame = 12;  // length, type, checksum
  if (bytes.size() < frame || at > bytes.size() - frame) return {};
  const std::size_t length = big_endian(bytes, at, 4);
  if (length > bytes.size() - frame - at) return {};
  return {bytes.substr(at + 4, 4), bytes.substr(at + 8, length), bytes.substr(at, frame + length)};
}

ImageContainer inspect_png(const std::string& name, std::string_view bytes) {
  ImageContainer image;
  image.is_png = true;
  bool has_pixels = false;
  for (std::size_t at = png_signature.size();;) {
    const Chunk chunk = chunk_at(bytes, at);
    if (chunk.type.empty()) truncated(name);
    if (!chunk.is_intact()) damaged(name);
    if (at == png_signature.size()) {
      if (chunk.type != "IHDR" || chunk.data.size() != 13) damaged(name);
      image.width = static_cast<int>(std::min<std::uint32_t>(big_endian(chunk.data, 0, 4), max_side + 1));
      image.height = static_cast<int>(std::min<std::uint32_t>(big_endian(chunk.data, 4, 4), max_side + 1));
      image.bits = static_cast<unsigned char>(chunk.data[8]);
      image.is_gray = chunk.data[9] == 0;
      check_size(name, image);
    }
    has_pixels = has_pixels || chunk.type == "IDAT";
    if (chunk.type == "IEND") {
      if (!has_pixels) damaged(name);
      return image;
    }
    at += chunk.whole.size();
  }
}

bool is_frame_header(unsigned marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Offset of the next marker's 0xFF behind entropy-coded data: stuffed zeros, restarts and fill bytes are data.
std::size_t end_of_scan(const std::string& name, std::string_view bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    if (bytes[at] != '\xff') continue;
    const auto next = static_cast<unsigned char>(bytes[at + 1]);
    if (next != 0x00 && next != 0xFF && (next < 0xD0 || next > 0xD7)) return at;
  }
  truncated(name);
}

ImageContainer inspect_jpeg(const std::string& name, std::string_view bytes) {
  ImageContainer image;
  bool has_header = false;
  int scans = 0;
  for (std::size_t at = 2;;) {
    if (at + 2 > bytes.size()) truncated(name);
    if (bytes[at] != '\xff') damaged(name);
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    if (marker == 0xD9) {
      if (scans == 0) damaged(name);
      check_size(name, image);
      return image;
    }
    if (at + 4 > bytes.size()) truncated(name);
    const std::size_t length = big_endian(bytes, at + 2, 2);
    if (length < 2) damaged(name);
    if (at + 2 + length > bytes.size()) truncated(name);
    if (is_frame_header(marker)) {
      // A second header, or one behind the pixels, would let the decoder see another size than the one judged here.
      if (length < 8 || has_header || scans > 0) damaged(name);
      has_header = true;
      image.bits = static_cast<unsigned char>(bytes[at + 4]);
      image.height = static_cast<int>(big_endian(bytes, at + 5, 2));
      image.width = static_cast<int>(big_endian(bytes, at + 7, 2));
      image.is_gray = bytes[at + 9] == 1;
    }
    at += 2 + length;
    if (marker == 0xDA) {
      if (++scans > max_scans) throw InputError(name, "has more scans than any camera or editor writes");
      at = end_of_scan(name, bytes, at);
    }
  }
}

}  // namespace

ImageContainer inspect_image(const std::string& name, const std::string& bytes) {
  const std::string_view view = bytes;
  if (view.empty()) throw InputError(name, "is empty");
  if (view.substr(0, png_signature.size()) == png_signature) return inspect_png(name, view);
  if (view.substr(0, jpeg_signature.size()) == jpeg_signature) return inspect_jpeg(name, view);
  if (png_signature.starts_with(view) || jpeg_signature.starts_with(view)) truncated(name);
  throw InputError(name, "is neither PNG nor JPEG");
}

std::string bare_png(const std::string& bytes) {
  const std::string_view view = bytes;
  std::string bare(png_signature);
  for (std::size_t at = png_signature.size();;) {
    const Chunk chunk = chunk_at(view, at);
    // Upper case in the first letter of a type: needed for the pixels.
    if ((chunk.type[0] & 0x20) == 0) bare += chunk.whole;
    if (chunk.type == "IEND") return bare;
    at += chunk.whole.size();
  }
}

}  // namespace odosplat
