// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The text form of a COLMAP model.
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"
#include "odosplat/io/text/text_rows.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

std::string place_of(std::size_t line) { return "line " + std::to_string(line); }

std::uint32_t word_id(const std::string& name, std::size_t line, std::string_view word, const char* what) {
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) {
    fail_line(name, line, quoted_word(word) + " is not the number of " + what);
  }
  return id;
}

template <std::size_t n>
void take_numbers(const std::string& name, std::size_t line, std::string_view& rest, double (&values)[n]) {
  for (double& value : values) value = word_number(name, line, take_word(rest));
}

// A value of a pose, which is nan or inf for an image without a pose.
double pose_number(const std::string& name, std::size_t line, std::string_view word) {
  const std::optional<double> value = number_of(word);
  return value && !std::isfinite(*value) ? *value : word_number(name, line, word);
}

// Whether the line is a list of observed pixels: `x y point` each, the point a whole number (-1: none).
bool holds_pixels(std::string_view line) {
  while (!trimmed(line).empty()) {
    if (!number_of(take_word(line)) || !number_of(take_word(line))) return false;
    const std::optional<double> point = number_of(take_word(line));
    if (!point || *point != std::floor(*point)) return false;
  }
  return true;
}

}  // namespace

ColmapCameras parse_colmap_cameras_text(const std::string& name, const std::string& text) {
  ColmapCameras cameras;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
    const std::uint32_t id = word_id(name, line, take_word(rest), "a camera");
    const std::string model(take_word(rest));
    colmap_parameter_count(name, place_of(line), model);  // throws for models that are not supported
    double size[2];
    take_numbers(name, line, rest, size);
    std::vector<double> parameters;
    while (!rest.empty()) parameters.push_back(word_number(name, line, take_word(rest)));
    const CameraFile camera = colmap_camera(name, place_of(line), model, size[0], size[1], parameters);
    if (!cameras.emplace(id, camera).second) {
      fail_line(name, line, "camera " + std::to_string(id) + " is listed twice");
    }
  });
  if (cameras.empty()) throw InputError(name, "lists no camera");
  return cameras;
}

// Two lines per image; the second, with the observed pixels, may be empty.
std::vector<ColmapImage> parse_colmap_images_text(const std::string& name, const std::string& text) {
  std::vector<ColmapImage> images;
  std::string_view lines = without_byte_order_mark(name, text);
  for (std::size_t number = 1; !lines.empty(); ++number) {
    std::string_view rest = trimmed(take_line(lines));
    if (rest.empty() || rest[0] == '#') continue;
    word_id(name, number, take_word(rest), "an image");
    double q[4];
    double t[3];
    for (double& value : q) value = pose_number(name, number, take_word(rest));
    for (double& value : t) value = pose_number(name, number, take_word(rest));
    const std::uint32_t camera = word_id(name, number, take_word(rest), "a camera");
    images.push_back(colmap_image(name, place_of(number), q, t, camera, std::string(rest)));
    ++number;
    if (!holds_pixels(take_line(lines))) {
      fail_line(name, number, "expected the pixels of the image above, `x y point` each, or an empty line");
    }
  }
  if (images.empty()) throw InputError(name, "lists no image");
  sort_colmap_images(name, images);
  return images;
}

PointCloud parse_colmap_points_text(const std::string& name, const std::string& text) {
  PointCloud cloud;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
    take_word(rest);  // the point's number
    double xyz[3];
    double rgb[3];
    take_numbers(name, line, rest, xyz);
    take_numbers(name, line, rest, rgb);
    add_colmap_point(name, place_of(line), xyz, rgb, cloud);
  });
  return cloud;
}

}  // namespace odosplat
