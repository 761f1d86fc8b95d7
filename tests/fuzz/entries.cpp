// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/fuzz/entries.hpp"

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "odosplat/camera/register_depth.hpp"
#include "odosplat/camera/undistort.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/camera/photometric.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/image/image_container.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"
#include "odosplat/io/sequence/transforms_file.hpp"
#include "odosplat/io/text/list_file.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "odosplat/io/trajectory/similarity_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::fuzz {
namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "contract broken: %s\n", what);
  std::abort();
}

template <typename Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const InputError& e) {
    const bool one_line = std::string(e.what()).find('\n') == std::string::npos;
    if (!one_line) std::fprintf(stderr, "%s\n", e.what());
    demand(one_line, "an error has one line");
  }
}

void demand_order(const Trajectory& trajectory) {
  demand(!trajectory.empty(), "a trajectory has poses");
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    demand(trajectory[i].T_world_camera.is_finite(), "poses are finite");
    demand(i == 0 || trajectory[i].time >= trajectory[i - 1].time, "times do not go back");
  }
}

void demand_camera(const CameraFile& file) {
  file.camera.check();
  demand(file.distortion.empty() || file.distortion.size() == 4 || file.distortion.size() == 5, "4 or 5 coefficients");
}

void demand_cameras(const ColmapCameras& cameras) {
  demand(!cameras.empty(), "a model has cameras");
  for (const auto& [id, camera] : cameras) demand_camera(camera);
}

void demand_images(const std::vector<ColmapImage>& images) {
  demand(!images.empty(), "a model has images");
  for (std::size_t i = 0; i < images.size(); ++i) {
    demand(!images[i].T_world_camera || images[i].T_world_camera->is_finite(), "poses are finite");
    demand(i == 0 || natural_less(images[i - 1].name, images[i].name), "names ascend");
  }
}

void demand_points(const PointCloud& cloud) {
  demand(cloud.colors.size() == cloud.size(), "a colour each");
  for (const Eigen::Vector3f& p : cloud.points) demand(p.allFinite(), "points are finite");
  for (const Eigen::Vector3f& c : cloud.colors) demand(c.minCoeff() >= 0.0F && c.maxCoeff() <= 1.0F, "colours 0..1");
}

// PCD and LAS are recognised by their first bytes as well as by the name: another format than the intended one may be
// read.
void cloud(const char* name, const std::string& bytes) {
  set_log_level("off");
  read_or_refuse([&] {
    const PointCloud read = parse_point_cloud(name, bytes);
    demand(read.size() > 0, "a cloud has points");
    demand(read.colors.empty() || read.has_colors(), "colours are all or nothing");
    demand(read.normals.empty() || read.has_normals(), "normals are all or nothing");
    for (const Eigen::Vector3f& p : read.points) demand(p.allFinite(), "points are finite");
    for (const Eigen::Vector3f& c : read.colors) demand(c.minCoeff() >= 0.0F && c.maxCoeff() <= 1.0F, "colours 0..1");
    for (const Eigen::Vector3f& n : read.normals) demand(n.norm() > 0.99F && n.norm() < 1.01F, "normals are unit");
  });
}

}  // namespace

// Only the container is checked: decoding, by external libraries, would take most of the time.
void image(const std::string& bytes) {
  read_or_refuse([&] {
    const ImageContainer container = inspect_image("fuzz", bytes);
    demand(container.width >= 1 && container.width <= 32768, "width is in range");
    demand(container.height >= 1 && container.height <= 32768, "height is in range");
    if (!container.is_png) return;
    const std::string bare = bare_png(bytes);
    demand(bare.size() <= bytes.size(), "a bare PNG is not longer");
    const ImageContainer again = inspect_image("fuzz", bare);
    demand(again.width == container.width && again.bits == container.bits, "a bare PNG says the same");
  });
}

void ply(const std::string& bytes) {
  set_log_level("off");
  read_or_refuse([&] {
    const Ply parsed = parse_ply("fuzz", bytes);
    for (const PlyElement& element : parsed.elements) {
      for (const PlyProperty& property : element.properties) {
        const std::size_t rows = std::visit([](const auto& v) { return v.size(); }, property.values);
        demand(rows == element.count, "a column has as many rows as its element");
      }
    }
  });
  cloud("fuzz.ply", bytes);
}

void pcd(const std::string& bytes) { cloud("fuzz.pcd", bytes); }
void las(const std::string& bytes) { cloud("fuzz.las", bytes); }
void cloud_text(const std::string& bytes) { cloud("fuzz.xyz", bytes); }

void trajectory(const std::string& bytes) {
  set_log_level("off");
  read_or_refuse([&] { demand_order(parse_trajectory("fuzz", bytes)); });
  read_or_refuse([&] {
    const std::optional<SE3> pose = parse_pose_matrix("fuzz", bytes);
    demand(!pose || pose->is_finite(), "poses are finite");
  });
}

void camera_file(const std::string& bytes) {
  read_or_refuse([&] {
    CameraFile file = parse_camera_file("fuzz", bytes);
    file.camera.check();
    demand(file.fy_sign == 1 || file.fy_sign == -1, "fy has a sign");
    demand(file.depth_scale > 0.0, "depth_scale is positive");
    if (file.camera.width * file.camera.height > 10000) return;
    const Undistorter undistorter(file.camera, file.distortion);
    undistorter.depth(DepthImage(file.camera.height, file.camera.width, 1.0F));
    undistorter.color(ColorImage(file.camera.height, file.camera.width, cv::Vec3f(1.0F, 1.0F, 1.0F)));
    if (!file.depth_camera) return;
    const Camera& depth = file.depth_camera->camera;
    if (depth.width * depth.height > 10000) return;
    registered_depth(DepthImage(depth.height, depth.width, 1.0F), depth, file.depth_camera->T_color_depth, file.camera);
  });
}

void sequence_lists(const std::string& bytes) {
  read_or_refuse([&] {
    std::vector<double> times;
    for (const ListedImage& image : parse_image_list("fuzz", bytes)) {
      demand(!image.path.empty(), "an image has a path");
      demand(times.empty() || image.time > times.back(), "times grow");
      times.push_back(image.time);
      demand(!natural_less(image.path, image.path), "the order is strict");
      demand(number_in(image.path) >= -1, "numbers are not negative");
    }
    if (times.size() < 200) demand(associate_by_time(times, times, 0.0).size() == times.size(), "all find themselves");
  });
  read_or_refuse([&] {
    for (const ListedPair& pair : parse_pair_list("fuzz", bytes)) {
      demand(!pair.color_path.empty() && !pair.depth_path.empty(), "a pair has two paths");
    }
  });
  const auto demand_exposures = [](const std::vector<double>& exposures, std::size_t frames) {
    demand(exposures.empty() || exposures.size() == frames, "an exposure a frame");
    for (const double exposure : exposures) demand(exposure >= 0.0, "exposures are not negative");
  };
  read_or_refuse([&] { demand_exposures(parse_exposures("fuzz", bytes, {1.0, 2.0}), 2); });
  read_or_refuse([&] { demand_exposures(parse_dso_times("fuzz", bytes, 2), 2); });
}

void colmap_text(const std::string& bytes) {
  read_or_refuse([&] { demand_cameras(parse_colmap_cameras_text("fuzz", bytes)); });
  read_or_refuse([&] { demand_images(parse_colmap_images_text("fuzz", bytes)); });
  read_or_refuse([&] { demand_points(parse_colmap_points_text("fuzz", bytes)); });
  read_or_refuse([&] {
    const PointPairs pairs = parse_point_pairs("fuzz", bytes);
    demand(pairs.source.size() == pairs.target.size(), "pairs have two ends");
  });
  read_or_refuse([&] { demand(parse_similarity("fuzz", bytes).scale > 0.0, "a scale is positive"); });
}

void colmap_binary(const std::string& bytes) {
  read_or_refuse([&] { demand_cameras(parse_colmap_cameras_binary("fuzz", bytes)); });
  read_or_refuse([&] { demand_images(parse_colmap_images_binary("fuzz", bytes)); });
  read_or_refuse([&] { demand_points(parse_colmap_points_binary("fuzz", bytes)); });
}

void transforms(const std::string& bytes) {
  set_log_level("off");
  read_or_refuse([&] {
    const TransformsFile file = parse_transforms("fuzz", bytes);
    demand(!file.frames.empty(), "there are frames");
    demand(file.depth_scale > 0.0, "depth_scale is positive");
    for (const TransformsFrame& frame : file.frames) {
      demand(!frame.color.empty(), "a frame has an image");
      demand(!frame.T_world_camera || frame.T_world_camera->is_finite(), "poses are finite");
    }
    demand_camera(file.camera("fuzz", {640, 480}));
  });
}

}  // namespace odosplat::fuzz
