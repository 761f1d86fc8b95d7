// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/io/camera/camera_file.hpp"

namespace odosplat {

/// What the files of a COLMAP model hold (Schoenberger and Frahm, "Structure-from-Motion Revisited", CVPR 2016), in
/// this project's conventions: COLMAP's principal points count from the corner of the first pixel, ours from its
/// centre, so half a pixel is taken off; its poses are world to camera, quaternion w x y z, ours camera to world. Both
/// have the camera's x right, y down, z forward. The world and its unit are the model's own: any scale.
///
/// Text files as `colmap model_converter` writes them, binary ones little endian. `name` stands for the file in errors.
/// InputError(name, "line N" or "image N", fault) for whatever is not of that form; nothing that a file promises is
/// allocated before it is there.

/// A registered image.
struct ColmapImage {
  std::string name;  // relative to the folder of images; no control characters
  std::uint32_t camera_id = 0;
  std::optional<SE3> T_world_camera;  // none: a value of it is not finite
};

/// By id. Models SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV; distortion k1 k2 p1 p2, empty if all are 0.
/// Any other model is refused by name.
using ColmapCameras = std::map<std::uint32_t, CameraFile>;
ColmapCameras parse_colmap_cameras_text(const std::string& name, const std::string& text);
ColmapCameras parse_colmap_cameras_binary(const std::string& name, const std::string& bytes);

/// In the natural order of their names, which differ. Observed pixels are read past.
std::vector<ColmapImage> parse_colmap_images_text(const std::string& name, const std::string& text);
std::vector<ColmapImage> parse_colmap_images_binary(const std::string& name, const std::string& bytes);

/// Points and colours in the file's order; errors and tracks are read past. A file without points gives an empty cloud.
PointCloud parse_colmap_points_text(const std::string& name, const std::string& text);
PointCloud parse_colmap_points_binary(const std::string& name, const std::string& bytes);

/// The same by the extension of the file, .bin or .txt.
ColmapCameras read_colmap_cameras(const std::string& path);
std::vector<ColmapImage> read_colmap_images(const std::string& path);
PointCloud read_colmap_points(const std::string& path);

/// Shared by both forms.

/// `place` names the camera in errors. The parameters are in the order of the model.
CameraFile colmap_camera(const std::string& name, const std::string& place, const std::string& model, double width,
                         double height, const std::vector<double>& parameters);
/// Names of COLMAP's models by number; empty for a number that is not known.
std::string colmap_model_name(int number);
/// How many parameters a model that we read has; InputError for the others.
std::size_t colmap_parameter_count(const std::string& name, const std::string& place, const std::string& model);
/// q: w x y z, t: of the world in the camera.
ColmapImage colmap_image(const std::string& name, const std::string& place, const double (&q)[4], const double (&t)[3],
                         std::uint32_t camera_id, std::string image_name);
/// InputError if two images have one name.
void sort_colmap_images(const std::string& name, std::vector<ColmapImage>& images);
/// xyz in the model's unit, rgb 0..255.
void add_colmap_point(const std::string& name, const std::string& place, const double (&xyz)[3], const double (&rgb)[3],
                      PointCloud& cloud);

}  // namespace odosplat
