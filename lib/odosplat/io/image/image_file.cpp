// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/image_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/image_container.hpp"

namespace odosplat {
namespace {

ImageContainer inspect_within(const std::string& name, const std::string& bytes, const ImageLimit& limit) {
  const ImageContainer container = inspect_image(name, bytes);
  limit.check(name, {container.width, container.height});
  return container;
}

cv::Mat decode(const std::string& name, const std::string& bytes, const ImageContainer& container, int flags) {
  const std::string bare = container.is_png ? bare_png(bytes) : std::string();
  const std::string& source = container.is_png ? bare : bytes;
  if (source.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw InputError(name, "is too large");
  // imdecode does not change the data, but its interface needs a non-const Mat.
  const cv::Mat data(1, static_cast<int>(source.size()), CV_8U, const_cast<char*>(source.data()));
  cv::Mat image;
  try {
    image = cv::imdecode(data, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.cols != container.width || image.rows != container.height) throw InputError(name, "is damaged");
  return image;
}

void write_png(const std::string& path, const cv::Mat& image) {
  if (image.empty()) throw InputError(path, "cannot be written: the image is empty");
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, Durability::fast);
}

unsigned char to_byte(float value) {
  if (!(value > 0.0F)) return 0;  // also for NaN
  return static_cast<unsigned char>(std::lround(255.0F * std::min(value, 1.0F)));
}

}  // namespace

void ImageLimit::check(const std::string& name, const cv::Size& size) const {
  if (std::int64_t{size.width} * size.height > max_pixels) {
    throw InputError(name, "is " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                               ", over the limit of " + std::to_string(max_pixels) + " pixels (--max-image-pixels)");
  }
  if (require_size) require_size(size);
}

std::uint64_t ImageLimit::max_bytes() const {
  constexpr std::uint64_t bytes_per_pixel = 8;
  constexpr std::uint64_t beside_pixels = std::uint64_t{64} << 20U;
  return bytes_per_pixel * static_cast<std::uint64_t>(max_pixels) + beside_pixels;
}

ColorImage parse_color(const std::string& name, const std::string& bytes, const ImageLimit& limit) {
  const cv::Mat decoded = decode(name, bytes, inspect_within(name, bytes, limit), cv::IMREAD_COLOR);
  cv::Mat3b rgb;
  cv::cvtColor(decoded, rgb, cv::COLOR_BGR2RGB);
  ColorImage color;
  rgb.convertTo(color, CV_32F, 1.0 / 255.0);
  return color;
}

cv::Mat1w parse_depth_raw(const std::string& name, const std::string& bytes, const ImageLimit& limit) {
  const ImageContainer container = inspect_within(name, bytes, limit);
  if (!container.is_png || !container.is_gray || container.bits != 16)
    throw InputError(name, "is not a 16-bit grey PNG");
  return decode(name, bytes, container, cv::IMREAD_UNCHANGED);
}

ColorImage read_color(const std::string& path, const ImageLimit& limit) {
  return parse_color(path, read_file(path, limit.max_bytes()), limit);
}

GrayImage read_gray(const std::string& path, const ImageLimit& limit) { return to_gray(read_color(path, limit)); }

cv::Mat1w read_depth_raw(const std::string& path, const ImageLimit& limit) {
  return parse_depth_raw(path, read_file(path, limit.max_bytes()), limit);
}

cv::Size read_image_size(const std::string& path, const ImageLimit& limit) {
  const ImageContainer container = inspect_within(path, read_file(path, limit.max_bytes()), limit);
  return {container.width, container.height};
}

void write_color(const std::string& path, const ColorImage& color) {
  cv::Mat3b rgb(color.size());
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      for (int c = 0; c < 3; ++c) rgb(y, x)[c] = to_byte(color(y, x)[c]);
    }
  }
  write_rgb8(path, rgb);
}

void write_rgb8(const std::string& path, const cv::Mat3b& rgb) {
  cv::Mat bgr;
  if (!rgb.empty()) cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  write_png(path, bgr);
}

void write_gray(const std::string& path, const GrayImage& gray) {
  cv::Mat1b bytes(gray.size());
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) bytes(y, x) = to_byte(gray(y, x));
  }
  write_png(path, bytes);
}

void write_png16(const std::string& path, const cv::Mat1w& image) { write_png(path, image); }

double largest_depth(double units_per_metre) { return 65534.0 / units_per_metre; }

std::size_t write_depth(const std::string& path, const DepthImage& depth, double units_per_metre) {
  cv::Mat1w units(depth.size(), std::uint16_t{0});
  std::size_t too_far = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(static_cast<double>(depth(y, x)) * units_per_metre);
      if (value > 0.0 && value < 65535.0) units(y, x) = static_cast<std::uint16_t>(value);
      if (value >= 65535.0) ++too_far;
    }
  }
  write_png16(path, units);
  return too_far;
}

}  // namespace odosplat
