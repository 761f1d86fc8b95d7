// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "odosplat/camera/register_depth.hpp"
#include "odosplat/camera/undistort.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/core/stamp_guess.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/camera/photometric.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/image/size_text.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/sequence/layouts.hpp"
#include "odosplat/io/sequence/sequence_index.hpp"
#include "odosplat/io/text/file_names.hpp"

namespace odosplat {
namespace {

constexpr int smallest_side = 2;  // [px]

const Layout& layout_named(const std::string& name) {
  std::string known;
  for (const Layout& layout : layouts()) {
    if (name == layout.name) return layout;
    known += std::string(known.empty() ? "" : ", ") + layout.name;
  }
  throw InputError("--layout", "`" + name + "` is not known; known are " + known);
}

const Layout& detect(const std::string& path) {
  std::string known;
  for (const Layout& layout : layouts()) {
    if (layout.matches(path)) return layout;
    known += std::string(known.empty() ? "" : ", ") + layout.name + " (" + layout.signature + ")";
  }
  throw InputError(path, "no known layout; known are " + known);
}

// F T F with F = diag(1, -1, 1): the same motion with the y axis of camera and world inverted.
SE3 reflected(const SE3& T) {
  const Eigen::Quaterniond& q = T.rotation();
  const Eigen::Vector3d& t = T.translation();
  return {Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z()), Eigen::Vector3d(t.x(), -t.y(), t.z())};
}

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
  std::int64_t max_image_pixels = ImageLimit::default_max_pixels;
  Undistorter undistorter;
  PhotometricCorrection photometric;
  std::vector<double> exposures;  // per frame, median 1; empty: not known

  mutable std::once_flag depth_scale_said;

  // Logged once, and only when depth is read, because nothing else needs the scale.
  void say_assumed_depth_scale() const {
    if (index.camera.has_depth_scale) return;
    std::call_once(depth_scale_said, [this] {
      log_warning(index.camera_source + " names no depth_scale: " + number_text(index.camera.depth_scale) +
                  " units per metre are assumed, as is usual for the layout " + layout);
    });
  }

  const FrameFiles& frame(std::size_t i) const {
    if (i >= index.frames.size()) throw std::out_of_range("frame " + std::to_string(i) + " of " + name);
    return index.frames[i];
  }
  double exposure(std::size_t i) const { return exposures.empty() ? 1.0 : exposures.at(i); }
  /// Path of the vignette; empty if there is none.
  std::string vignette_file() const {
    if (index.camera.vignette.empty()) return {};
    return listed_file(std::filesystem::path(index.camera_source).parent_path().string(), index.camera.vignette);
  }
  cv::Size camera_size() const { return {index.camera.camera.width, index.camera.camera.height}; }

  void require_camera_size(const std::string& file, const cv::Size& size) const {
    if (size != camera_size()) {
      throw InputError(file,
                       "is " + size_text(size) + ", " + index.camera_source + " is for " + size_text(camera_size()));
    }
  }

  ImageLimit any_size() const { return {max_image_pixels, {}}; }
  ImageLimit camera_size_only(const std::string& file) const {
    return {max_image_pixels, [this, &file](const cv::Size& size) { require_camera_size(file, size); }};
  }

  void require_depth_size(const FrameFiles& files, const cv::Size& size) const {
    if (index.camera.depth_camera) {
      const Camera& camera = index.camera.depth_camera->camera;
      if (size == cv::Size(camera.width, camera.height)) return;
      throw InputError(files.depth, "is " + size_text(size) + ", the depth_camera of " + index.camera_source +
                                        " is for " + size_text({camera.width, camera.height}));
    }
    if (size == camera_size()) return;
    if (const cv::Size color = read_image_size(files.color, any_size()); color != size) {
      throw InputError(files.depth,
                       "is " + size_text(size) + ", its colour image " + files.color + " is " + size_text(color));
    }
    require_camera_size(files.depth, size);
  }

  /// Throws if none of the first images has the camera's size, since the camera is then wrong. A single damaged image
  /// or one of another size is accepted here and reported when that frame is read.
  void require_size_of_images() const {
    constexpr std::size_t most = 32;  // number of images checked
    std::optional<InputError> first_fault;
    for (std::size_t i = 0; i < std::min(most, index.frames.size()); ++i) {
      const std::string& file = index.frames[i].color;
      try {
        read_image_size(file, camera_size_only(file));
        return;
      } catch (const InputError& e) {
        if (!first_fault) first_fault = e;
      }
    }
    if (first_fault) throw *first_fault;
  }

  void read_photometric_calibration(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
      std::vector<double> times;
      for (const FrameFiles& f : index.frames) times.push_back(f.time);
      exposures = read_exposures(path, times);
    }
    cv::Mat1f vignette;
    if (const std::string file = vignette_file(); !file.empty()) {
      vignette = read_vignette(file, camera_size_only(file));
    }
    const double gamma = index.camera.gamma > 0.0 ? index.camera.gamma : 1.0;
    photometric = PhotometricCorrection(gamma, vignette);
  }

  /// Sets the poses of all images and depth images, and the true poses by the images' stamps.
  void set_poses() {
    const double offset = index.camera.time_offset;
    const double depth_offset = index.camera.depth_time_offset();
    std::size_t unposed = 0;
    std::size_t unposed_depth = 0;
    for (FrameFiles& f : index.frames) {
      if (!index.poses_by_time && f.T_world_camera) {
        const SE3 at_stamp = *f.T_world_camera;
        const auto pose_after = [&](double seconds) {
          return seconds == 0.0 ? std::optional<SE3>(at_stamp) : pose_at(index.truth, f.time + seconds);
        };
        f.T_world_depth = pose_after(depth_offset);
        f.T_world_camera = pose_after(offset);
      }
      if (!f.T_world_camera && offset != 0.0 && pose_at(index.truth, f.time)) ++unposed;
      if (f.depth.empty()) {
        f.T_world_depth = f.T_world_camera;
      } else if (depth_offset == offset) {
        if (!f.T_world_depth) f.T_world_depth = f.T_world_camera;
      } else if (!f.T_world_camera) {
        f.T_world_depth.reset();
      } else {
        unposed_depth += f.T_world_depth ? 0 : 1;
      }
    }
    if (unposed_depth > 0) {
      log_warning(name + ": " + std::to_string(unposed_depth) + " depth images have no pose at their time" +
                  (depth_offset == 0.0 ? "" : ", which time_offset of depth_camera moves"));
    }
    if (offset == 0.0 || index.truth.empty()) return;
    if (unposed > 0) {
      log_warning(name + ": " + std::to_string(unposed) + " of " + std::to_string(index.frames.size()) +
                  " images have no pose at their time, which time_offset of " + index.camera_source + " moves");
    }
    for (const FrameFiles& f : index.frames) {
      if (f.T_world_camera) truth_of_images.push_back({f.time, *f.T_world_camera, f.time_text});
    }
  }

  void require_near() const {
    require_near_origin(name, index.truth);
    std::vector<Eigen::Vector3d> positions;
    for (const FrameFiles& f : index.frames) {
      if (f.T_world_camera) positions.push_back(f.T_world_camera->translation());
    }
    require_near_origin(name, positions);
  }

  void require_files() {
    bool any_depth = false;
    bool wants_depth = false;
    std::size_t missing = 0;
    std::optional<InputError> first_fault;
    for (const FrameFiles& f : index.frames) {
      if (!index.video) {
        try {
          require_regular_file(f.color);
        } catch (const InputError& e) {
          if (missing++ == 0) first_fault = e;
        }
      }
      wants_depth = wants_depth || !f.depth.empty();
      any_depth = any_depth || (!f.depth.empty() && file_exists(f.depth));
    }
    // A missing image, like a damaged one, is an error only when its frame is read; if all are missing, throw here.
    if (first_fault && missing == index.frames.size()) throw *first_fault;
    if (first_fault) {
      log_warning(name + ": " + std::to_string(missing) + " of " + std::to_string(index.frames.size()) +
                  " listed images are not there, such as " + first_fault->what());
    }
    if (wants_depth && !any_depth) {
      log_debug(name + ": the listed depth files are not there; reading without depth");
      for (FrameFiles& f : index.frames) f.depth.clear();
    }
  }
};

Sequence Sequence::open(const std::string& path, const SequenceOptions& options) {
  options.check();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path, "is missing");
  const Layout& layout = options.layout.empty() ? detect(path) : layout_named(options.layout);
  auto data = std::make_shared<Data>();
  data->name = last_part(path);
  data->layout = layout.name;
  data->max_image_pixels = options.max_image_pixels;
  data->index = layout.index(path, options);
  SequenceIndex& index = data->index;
  check_camera(index.camera_source, index.camera);
  data->require_files();
  data->reflected = index.camera.fy_sign < 0 && !options.as_stored;
  if (data->reflected) {
    for (FrameFiles& f : index.frames) {
      if (f.T_world_camera) f.T_world_camera = reflected(*f.T_world_camera);
      if (f.T_world_depth) f.T_world_depth = reflected(*f.T_world_depth);
    }
    for (StampedPose& pose : index.truth) pose.T_world_camera = reflected(pose.T_world_camera);
  }
  data->set_poses();
  data->require_near();
  const double listed_fps = median_fps(index.frames);
  data->fps = index.camera.fps > 0.0 ? index.camera.fps : listed_fps;
  if (const std::string unit = unit_of_step(1.0 / listed_fps); !unit.empty()) {
    log_warning(path + ": its images are " + std::to_string(1.0 / listed_fps) +
                " s apart (median): their stamps look like " + unit + " where seconds are expected");
  }
  // The camera's size is checked against the pixel limit too: videos have no image header to check, and undistortion
  // allocates images of the camera's size.
  data->any_size().check(index.camera_source, data->camera_size());
  if (index.video) {
    data->require_camera_size(path, index.video->frame_size());
  } else {
    data->require_size_of_images();
  }
  // Interpolation and gradients need a neighbouring pixel.
  if (const cv::Size size = data->camera_size(); size.width < smallest_side || size.height < smallest_side) {
    throw InputError(path, "images of " + size_text(size) + " are too small, must have " +
                               std::to_string(smallest_side) + " pixels each way at least");
  }
  // Last, because only here has the size in the camera file been verified.
  data->undistorter = Undistorter(index.camera.camera, index.camera.distortion);
  data->read_photometric_calibration(path);
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

bool Sequence::has_exposures() const { return !data_->exposures.empty(); }

double Sequence::exposure(std::size_t i) const {
  data_->frame(i);
  return data_->exposure(i);
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
  file.vignette = data_->vignette_file();
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
  const FrameFiles& files = data_->frame(i);
  ColorImage image;
  if (data_->index.video) {
    data_->index.video->frame(i).convertTo(image, CV_32F, 1.0 / 255.0);
  } else {
    image = read_color(files.color, data_->camera_size_only(files.color));
  }
  return data_->undistorter.color(data_->photometric.apply(image, data_->exposure(i)));
}

DepthImage Sequence::depth(std::size_t i) const {
  const FrameFiles& files = data_->frame(i);
  if (files.depth.empty()) throw InputError(data_->name, "frame " + std::to_string(i), "has no depth image");
  data_->say_assumed_depth_scale();
  const ImageLimit limit{data_->max_image_pixels,
                         [&](const cv::Size& size) { data_->require_depth_size(files, size); }};
  const cv::Mat1w raw = read_depth_raw(files.depth, limit);
  DepthImage depth(raw.size());
  const double metres = 1.0 / data_->index.camera.depth_scale;
  for (int y = 0; y < raw.rows; ++y) {
    const std::uint16_t* from = raw[y];
    float* to = depth[y];
    for (int x = 0; x < raw.cols; ++x) to[x] = from[x] == 65535 ? 0.0F : static_cast<float>(from[x] * metres);
  }
  if (const std::optional<DepthCamera>& other = data_->index.camera.depth_camera; other) {
    DepthImage registered = registered_depth(depth, other->camera, other->T_color_depth, camera());
    data_->undistorter.mask_unseen(registered);
    return registered;
  }
  return data_->undistorter.depth(depth);
}

}  // namespace odosplat
