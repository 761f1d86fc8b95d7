// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The binary form of a COLMAP model: little endian, without padding.
#include <bit>
#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"

namespace odosplat {
namespace {

constexpr std::uint64_t bytes_a_pixel = 24;  // double x, y; uint64 point
constexpr std::uint64_t bytes_a_track = 8;   // uint32 image, pixel

// Reads values from the start of the remaining bytes. `place` is the current entry, for errors.
class Bytes {
 public:
  Bytes(std::string name, std::string_view rest) : name_(std::move(name)), rest_(rest) {
    count_ = integer<std::uint64_t>();
  }

  /// Number of entries, from the first eight bytes of the file.
  std::uint64_t count() const { return count_; }
  void set_place(const char* what, std::uint64_t index) {
    place_ = std::string(what) + " " + std::to_string(index + 1) + " of " + std::to_string(count_);
  }
  const std::string& place() const { return place_; }

  template <typename T>
  T integer() {
    const std::string_view from = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value = static_cast<T>(value | static_cast<T>(static_cast<T>(static_cast<unsigned char>(from[i])) << (8 * i)));
    }
    return value;
  }
  double real() { return std::bit_cast<double>(integer<std::uint64_t>()); }

  template <std::size_t n>
  void reals(double (&values)[n]) {
    for (double& value : values) value = real();
  }

  /// Reads up to the next zero byte, which is consumed too.
  std::string text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) fail_end();
    const std::string_view from = take(end + 1);
    return std::string(from.substr(0, end));
  }

  /// To be called after the last entry: throws InputError if the file goes on.
  void expect_end() const {
    if (rest_.empty()) return;
    throw InputError(name_, "promises " + std::to_string(count_) + " entries, and goes on for " +
                                std::to_string(rest_.size()) + " bytes behind them");
  }

  /// Skips a list: its length, then that many entries.
  void skip_list(std::uint64_t bytes_an_entry) {
    const auto n = integer<std::uint64_t>();
    if (n > rest_.size() / bytes_an_entry) fail_end();
    take(static_cast<std::size_t>(n * bytes_an_entry));
  }

 private:
  std::string_view take(std::size_t n) {
    if (rest_.size() < n) fail_end();
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }
  [[noreturn]] void fail_end() const { throw InputError(name_, place_, "the file ends in the middle of it"); }

  std::string name_;
  std::string_view rest_;
  std::string place_ = "the number of entries";
  std::uint64_t count_ = 0;
};

}  // namespace

ColmapCameras parse_colmap_cameras_binary(const std::string& name, const std::string& bytes) {
  ColmapCameras cameras;
  Bytes in(name, bytes);
  for (std::uint64_t i = 0; i < in.count(); ++i) {
    in.set_place("camera", i);
    const auto id = in.integer<std::uint32_t>();
    const auto number = static_cast<std::int32_t>(in.integer<std::uint32_t>());
    const auto width = static_cast<double>(in.integer<std::uint64_t>());
    const auto height = static_cast<double>(in.integer<std::uint64_t>());
    std::string model = colmap_model_name(number);
    if (model.empty()) model = "number " + std::to_string(number);
    std::vector<double> parameters(colmap_parameter_count(name, in.place(), model));
    for (double& parameter : parameters) parameter = in.real();
    if (!cameras.emplace(id, colmap_camera(name, in.place(), model, width, height, parameters)).second) {
      throw InputError(name, in.place(), "camera " + std::to_string(id) + " is listed twice");
    }
  }
  in.expect_end();
  if (cameras.empty()) throw InputError(name, "lists no camera");
  return cameras;
}

std::vector<ColmapImage> parse_colmap_images_binary(const std::string& name, const std::string& bytes) {
  std::vector<ColmapImage> images;
  Bytes in(name, bytes);
  for (std::uint64_t i = 0; i < in.count(); ++i) {
    in.set_place("image", i);
    in.integer<std::uint32_t>();  // its number
    double q[4];
    double t[3];
    in.reals(q);
    in.reals(t);
    const auto camera = in.integer<std::uint32_t>();
    std::string image = in.text();
    in.skip_list(bytes_a_pixel);
    images.push_back(colmap_image(name, in.place(), q, t, camera, std::move(image)));
  }
  in.expect_end();
  if (images.empty()) throw InputError(name, "lists no image");
  sort_colmap_images(name, images);
  return images;
}

PointCloud parse_colmap_points_binary(const std::string& name, const std::string& bytes) {
  PointCloud cloud;
  Bytes in(name, bytes);
  for (std::uint64_t i = 0; i < in.count(); ++i) {
    in.set_place("point", i);
    in.integer<std::uint64_t>();  // its number
    double xyz[3];
    in.reals(xyz);
    double rgb[3];
    for (double& value : rgb) value = in.integer<std::uint8_t>();
    in.real();  // reprojection error
    in.skip_list(bytes_a_track);
    add_colmap_point(name, in.place(), xyz, rgb, cloud);
  }
  in.expect_end();
  return cloud;
}

}  // namespace odosplat
