// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/sequence.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/stamp_guess.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_images.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/sequence/sequence_poses.hpp"

namespace odosplat {
namespace {

double median_fps(const std::vector<FrameFiles>& frames) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < frames.size(); ++i) steps.push_back(frames[i].time - frames[i - 1].time);
  if (steps.empty()) return default_fps;
  return 1.0 / upper_median(std::move(steps));
}

std::string last_part(const std::string& path) {
  const std::filesystem::path full = std::filesystem::absolute(path).lexically_normal();
  return (full.has_filename() ? full : full.parent_path()).filename().string();
}

}  // namespace

void SequenceOptions::check() const {
  if (!layout.empty()) layout_named(layout);
  require(max_image_pixels >= 1 && max_image_pixels <= ImageLimit::most_pixels, "--max-image-pixels", "1 to 2^30");
}

struct Sequence::Data {
  std::string name;
  std::string layout;
  SequenceIndex index;
  double fps = default_fps;
  Trajectory truth_of_images;  // with a time_offset of the images: their poses, at their stamps; else empty
  bool reflected = false;
  std::optional<SequenceImages> images;  // refers to index

  const FrameFiles& frame(std::size_t i) const {
    if (i >= index.frames.size()) throw std::out_of_range("frame " + std::to_string(i) + " of " + name);
    return index.frames[i];
  }
};

Sequence Sequence::open(const std::string& path, const SequenceOptions& options) {
  options.check();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path, "is missing");
  const Layout& layout = options.layout.empty() ? detect_layout(path) : layout_named(options.layout);
  auto data = std::make_shared<Data>();
  data->name = last_part(path);
  data->layout = layout.name;
  data->index = layout.index(path, options);
  SequenceIndex& index = data->index;
  check_camera(index.camera_source, index.camera);
  require_files(data->name, index);
  data->reflected = index.camera.fy_sign < 0 && !options.as_stored;
  if (data->reflected) reflect_poses(index);
  data->truth_of_images = set_poses(data->name, index);
  require_near(data->name, index);
  const double listed_fps = median_fps(index.frames);
  data->fps = index.camera.fps > 0.0 ? index.camera.fps : listed_fps;
  if (const std::string unit = unit_of_step(1.0 / listed_fps); !unit.empty()) {
    log_warning(path + ": its images are " + std::to_string(1.0 / listed_fps) +
                " s apart (median): their stamps look like " + unit + " where seconds are expected");
  }
  data->images.emplace(path, data->layout, index, options.max_image_pixels);
  return Sequence(std::move(data));
}

const std::string& Sequence::name() const { return data_->name; }
const std::string& Sequence::layout() const { return data_->layout; }
const Camera& Sequence::camera() const { return data_->index.camera.camera; }
int Sequence::fy_sign() const { return data_->index.camera.fy_sign; }
double Sequence::depth_scale() const { return data_->index.camera.depth_scale; }
double Sequence::fps() const { return data_->fps; }
std::size_t Sequence::size() const { return data_->index.frames.size(); }
double Sequence::time(std::size_t i) const { return data_->frame(i).time; }
const Trajectory& Sequence::listed_poses() const { return data_->index.truth; }
bool Sequence::has_depth(std::size_t i) const { return !data_->frame(i).depth.empty(); }
GrayImage Sequence::gray(std::size_t i) const { return to_gray(color(i)); }

const Trajectory& Sequence::truth() const {
  return data_->index.camera.time_offset == 0.0 ? data_->index.truth : data_->truth_of_images;
}

bool Sequence::has_exposures() const { return data_->images->has_exposures(); }

double Sequence::exposure(std::size_t i) const {
  data_->frame(i);
  return data_->images->exposure(i);
}

bool Sequence::has_sparse_points() const { return !data_->index.sparse_points.file.empty(); }

PointCloud Sequence::sparse_points() const {
  const SparsePoints& points = data_->index.sparse_points;
  if (points.file.empty()) throw InputError(data_->name, "has no sparse points");
  PointCloud cloud = points.read(points.file);
  if (cloud.size() == 0) throw InputError(points.file, "holds no point");
  if (data_->reflected) {
    for (Eigen::Vector3f& p : cloud.points) p.y() = -p.y();
    for (Eigen::Vector3f& n : cloud.normals) n.y() = -n.y();
  }
  return cloud;
}

CameraFile Sequence::camera_file() const {
  CameraFile file = data_->index.camera;
  file.fy_sign = 1;
  file.fps = data_->fps;
  file.vignette = vignette_path(data_->index.camera, data_->index.camera_source);
  return file;
}

CameraFile Sequence::declared_camera() const {
  CameraFile file = camera_file();
  file.fy_sign = fy_sign();
  file.fps = data_->index.camera.fps;
  if (!file.vignette.empty()) file.vignette = std::filesystem::absolute(file.vignette).lexically_normal().string();
  return file;
}

bool Sequence::poses_by_time() const { return data_->index.poses_by_time; }

std::size_t Sequence::posed_with_offset(double time_offset) const {
  std::size_t posed = 0;
  for (const FrameFiles& frame : data_->index.frames) {
    posed += pose_at(data_->index.truth, frame.time + time_offset) ? 1 : 0;
  }
  return posed;
}

const std::string& Sequence::color_file(std::size_t i) const { return data_->frame(i).color; }
const std::string& Sequence::depth_file(std::size_t i) const { return data_->frame(i).depth; }

std::string Sequence::depth_time_text(std::size_t i) const {
  const FrameFiles& frame = data_->frame(i);
  return frame.depth_time_text.empty() ? time_text(i) : frame.depth_time_text;
}

std::string Sequence::time_text(std::size_t i) const {
  const FrameFiles& frame = data_->frame(i);
  return StampedPose{frame.time, {}, frame.time_text}.stamp();
}

std::optional<SE3> Sequence::T_world_camera(std::size_t i) const { return data_->frame(i).T_world_camera; }
std::optional<SE3> Sequence::T_world_depth(std::size_t i) const { return data_->frame(i).T_world_depth; }

ColorImage Sequence::color(std::size_t i) const {
  data_->frame(i);
  return data_->images->color(i);
}

DepthImage Sequence::depth(std::size_t i) const {
  if (!has_depth(i)) throw InputError(data_->name, "frame " + std::to_string(i), "has no depth image");
  return data_->images->depth(i);
}

}  // namespace odosplat
