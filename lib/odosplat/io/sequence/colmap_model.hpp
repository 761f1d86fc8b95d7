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

/// The contents of a COLMAP model's files (Schoenberger and Frahm, "Structure-from-Motion Revisited", CVPR 2016),
/// converted to this project's conventions:
///   - COLMAP measures the principal point from the corner of the first pixel, odosplat from its centre: half a pixel
///     is subtracted.
///   - COLMAP's poses are world to camera with the quaternion as w x y z; here they are camera to world.
/// The camera axes are the same (x right, y down, z forward). The world frame and its scale are the model's own.
///
/// Text files are as `colmap model_converter` writes them, binary files are little endian. `name` stands for the file
/// in errors. Throws InputError(name, "line N" or "image N", fault) for a file of another form. A count in a file is
/// checked against the file's size before memory is allocated for it.

/// A registered image.
struct ColmapImage {
  std::string name;  // relative to the folder of images; no control characters
  std::uint32_t camera_id = 0;
  std::optional<SE3> T_world_camera;  // none if a value in the file is not finite
};

/// Cameras by id. Models SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV; distortion k1 k2 p1 p2, empty if all
/// are 0. The error for any other model names it.
using ColmapCameras = std::map<std::uint32_t, CameraFile>;
ColmapCameras parse_colmap_cameras_text(const std::string& name, const std::string& text);
ColmapCameras parse_colmap_cameras_binary(const std::string& name, const std::string& bytes);

/// Images in the natural order of their names, which are unique. Observed pixels are skipped.
std::vector<ColmapImage> parse_colmap_images_text(const std::string& name, const std::string& text);
std::vector<ColmapImage> parse_colmap_images_binary(const std::string& name, const std::string& bytes);

/// Points and colours in the file's order; errors and tracks are skipped. A file without points gives an empty cloud.
PointCloud parse_colmap_points_text(const std::string& name, const std::string& text);
PointCloud parse_colmap_points_binary(const std::string& name, const std::string& bytes);

/// The same from a file, binary or text by its extension (.bin or .txt).
ColmapCameras read_colmap_cameras(const std::string& path);
std::vector<ColmapImage> read_colmap_images(const std::string& path);
PointCloud read_colmap_points(const std::string& path);

/// Shared by the readers of the text and the binary form.

/// `place` names the camera in errors. The parameters are in COLMAP's order for the model.
CameraFile colmap_camera(const std::string& name, const std::string& place, const std::string& model, double width,
                         double height, const std::vector<double>& parameters);
/// Name of the COLMAP camera model with that number; empty for an unknown number.
std::string colmap_model_name(int number);
/// Number of parameters of a supported camera model; InputError for other models.
std::size_t colmap_parameter_count(const std::string& name, const std::string& place, const std::string& model);
/// q: w x y z, t: the world-to-camera transform, as COLMAP stores it.
ColmapImage colmap_image(const std::string& name, const std::string& place, const double (&q)[4], const double (&t)[3],
                         std::uint32_t camera_id, std::string image_name);
/// Throws InputError if two images have the same name.
void sort_colmap_images(const std::string& name, std::vector<ColmapImage>& images);
/// xyz in the model's unit, rgb 0..255.
void add_colmap_point(const std::string& name, const std::string& place, const double (&xyz)[3], const double (&rgb)[3],
                      PointCloud& cloud);

}  // namespace odosplat
