// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/colmap_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

constexpr double corner_to_centre = 0.5;  // [px]

// Index: COLMAP's number of the model.
constexpr std::array<const char*, 12> model_names{"SIMPLE_PINHOLE",
                                                  "PINHOLE",
                                                  "SIMPLE_RADIAL",
                                                  "RADIAL",
                                                  "OPENCV",
                                                  "OPENCV_FISHEYE",
                                                  "FULL_OPENCV",
                                                  "FOV",
                                                  "SIMPLE_RADIAL_FISHEYE",
                                                  "RADIAL_FISHEYE",
                                                  "THIN_PRISM_FISHEYE",
                                                  "RAD_TAN_THIN_PRISM_FISHEYE"};

struct ReadableModel {
  const char* name;
  std::size_t focal_lengths;  // 1 or 2; the parameters are these, then cx cy, then the distortion
  std::size_t distortion;
};
constexpr std::array<ReadableModel, 5> readable{
    {{"SIMPLE_PINHOLE", 1, 0}, {"PINHOLE", 2, 0}, {"SIMPLE_RADIAL", 1, 1}, {"RADIAL", 1, 2}, {"OPENCV", 2, 4}}};

const ReadableModel& readable_model(const std::string& name, const std::string& place, const std::string& model) {
  std::string known;
  for (const ReadableModel& r : readable) {
    if (model == r.name) return r;
    known += std::string(known.empty() ? "" : ", ") + r.name;
  }
  throw InputError(name, place,
                   "camera model " + quoted_word(model) + " is not read; read are " + known +
                       " (`colmap image_undistorter` makes PINHOLE of any)");
}

bool is_binary(const std::string& path) { return path.ends_with(".bin"); }

}  // namespace

std::string colmap_model_name(int number) {
  if (number < 0 || number >= static_cast<int>(model_names.size())) return "";
  return model_names[static_cast<std::size_t>(number)];
}

std::size_t colmap_parameter_count(const std::string& name, const std::string& place, const std::string& model) {
  const ReadableModel& r = readable_model(name, place, model);
  return r.focal_lengths + 2 + r.distortion;
}

CameraFile colmap_camera(const std::string& name, const std::string& place, const std::string& model, double width,
                         double height, const std::vector<double>& parameters) {
  const ReadableModel& r = readable_model(name, place, model);
  const std::size_t expected = r.focal_lengths + 2 + r.distortion;
  if (parameters.size() != expected) {
    throw InputError(
        name, place,
        model + " has " + std::to_string(expected) + " parameters, here are " + std::to_string(parameters.size()));
  }
  for (const double size : {width, height}) {
    if (!(size >= 1.0 && size <= 32768.0) || size != std::floor(size)) {
      throw InputError(name, place, "the size is not in 1..32768 pixels");
    }
  }
  CameraFile file;
  const double* centre = parameters.data() + r.focal_lengths;
  file.camera = {static_cast<int>(width),         static_cast<int>(height),     parameters[0],
                 parameters[r.focal_lengths - 1], centre[0] - corner_to_centre, centre[1] - corner_to_centre};
  std::vector<double> distortion(4, 0.0);
  std::copy_n(centre + 2, r.distortion, distortion.begin());
  for (const double d : distortion) {
    if (!std::isfinite(d)) throw InputError(name, place, "a parameter is not finite");
    if (d != 0.0) file.distortion = distortion;
  }
  try {
    file.camera.check();
  } catch (const InputError& e) {
    throw InputError(name, place, e.what());
  }
  return file;
}

ColmapImage colmap_image(const std::string& name, const std::string& place, const double (&q)[4], const double (&t)[3],
                         std::uint32_t camera_id, std::string image_name) {
  if (image_name.empty()) throw InputError(name, place, "has no name");
  if (has_control_characters(image_name)) throw InputError(name, place, "its name holds control characters");
  const Eigen::Vector3d translation(t[0], t[1], t[2]);
  const Eigen::Quaterniond written(q[0], q[1], q[2], q[3]);
  if (!written.coeffs().allFinite() || !translation.allFinite())
    return {std::move(image_name), camera_id, std::nullopt};
  SE3 T_world_camera;
  try {
    T_world_camera = SE3(rotation_from_text(written), translation).inverse();
  } catch (const InputError& e) {
    throw InputError(name, place, e.what());
  }
  if (!T_world_camera.is_finite()) throw InputError(name, place, "its pose is out of range");
  return {std::move(image_name), camera_id, T_world_camera};
}

void sort_colmap_images(const std::string& name, std::vector<ColmapImage>& images) {
  std::sort(images.begin(), images.end(),
            [](const ColmapImage& a, const ColmapImage& b) { return natural_less(a.name, b.name); });
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].name == images[i - 1].name) throw InputError(name, "image " + images[i].name, "is listed twice");
  }
}

void add_colmap_point(const std::string& name, const std::string& place, const double (&xyz)[3], const double (&rgb)[3],
                      PointCloud& cloud) {
  const Eigen::Vector3d p(xyz[0], xyz[1], xyz[2]);
  // Limit below which squares of distances do not overflow in single precision.
  if (!(p.cwiseAbs().maxCoeff() < 1e15) || !p.allFinite()) throw InputError(name, place, "its place is out of range");
  const Eigen::Vector3d color(rgb[0], rgb[1], rgb[2]);
  if (!(color.minCoeff() >= 0.0 && color.maxCoeff() <= 255.0)) {
    throw InputError(name, place, "its colour is not in 0..255");
  }
  cloud.points.push_back(p.cast<float>());
  cloud.colors.push_back((color / 255.0).cast<float>());
}

ColmapCameras read_colmap_cameras(const std::string& path) {
  const std::string content = read_file(path, max_data_bytes);
  return is_binary(path) ? parse_colmap_cameras_binary(path, content) : parse_colmap_cameras_text(path, content);
}

std::vector<ColmapImage> read_colmap_images(const std::string& path) {
  const std::string content = read_file(path, max_data_bytes);
  return is_binary(path) ? parse_colmap_images_binary(path, content) : parse_colmap_images_text(path, content);
}

PointCloud read_colmap_points(const std::string& path) {
  const std::string content = read_file(path, max_data_bytes);
  return is_binary(path) ? parse_colmap_points_binary(path, content) : parse_colmap_points_text(path, content);
}

}  // namespace odosplat
