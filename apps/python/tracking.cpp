// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "apps/input/method.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "apps/python/maps.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"
#include "odosplat/splat/map_places.hpp"

namespace odosplat::python {
namespace {

struct TrackerSettings {
  std::optional<SE3> T_world_camera_start;  // none: to be looked up
  bool relocalise = true;
  bool background = false;
  std::uint64_t seed = 0;
  std::string device;
  std::vector<SE3> places;  // empty: the map's
  apps::OptionValues options;
};

/// A map with what tracks a camera in it, as `odosplat track` puts it together for method gaussian. One thread at a
/// time; others wait.
class HeldTracker {
 public:
  HeldTracker(std::shared_ptr<HeldMap> map, ImageInput input, const TrackerSettings& settings)
      : map_(std::move(map)), input_(std::move(input)), view_(open_device(settings.device), map_->map()) {
    OdometryOptions options = apps::odometry_options(apps::method_preset("gaussian"), std::nullopt);
    options.keyframe.selector.seed = settings.seed;
    options.background = settings.background;
    settings.options.apply(options);
    const std::optional<SE3>& start = settings.T_world_camera_start;
    if (settings.relocalise || !start) {
      RelocalizerOptions look_up;
      settings.options.apply(look_up);
      relocalizer_.emplace(input_.camera(), view_, settings.places.empty() ? map_->places() : settings.places, look_up);
    }
    odometry_ = apps::start_odometry(input_.camera(), view_, options, relocalizer_ ? &*relocalizer_ : nullptr, start,
                                     settings.background);
  }

  const ImageInput& input() const { return input_; }

  TrackResult track(const RawImage& image, double time) {
    const std::lock_guard lock(mutex_);
    if (!std::isfinite(time)) throw InputError("time", "must be finite [s]");
    if (last_time_ && !(time > *last_time_)) throw InputError("time", "must grow from image to image");
    const GrayImage gray = input_.gray(image);
    last_time_ = time;
    return odometry_->track(gray, time);
  }
  void finish() {
    const std::lock_guard lock(mutex_);
    odometry_->finish();
  }
  Trajectory trajectory() {
    const std::lock_guard lock(mutex_);
    return odometry_->trajectory();
  }
  std::vector<double> keyframe_times() {
    const std::lock_guard lock(mutex_);
    return odometry_->keyframe_times();
  }
  OdometryStatistics statistics() {
    const std::lock_guard lock(mutex_);
    return odometry_->statistics();
  }

 private:
  std::shared_ptr<HeldMap> map_;
  ImageInput input_;
  GaussianView view_;
  std::optional<Relocalizer> relocalizer_;
  std::unique_ptr<Odometry> odometry_;  // after what it refers to
  std::optional<double> last_time_;
  std::mutex mutex_;
};

std::unique_ptr<HeldTracker> make(const std::shared_ptr<HeldMap>& map, const py::object& camera,
                                  const std::string& order, const py::object& start, bool relocalise, bool background,
                                  std::uint64_t seed, const py::object& places, const std::vector<std::string>& options,
                                  const std::string& device) {
  TrackerSettings settings;
  if (!start.is_none()) settings.T_world_camera_start = pose_from(start, "start");
  settings.relocalise = relocalise;
  settings.background = background;
  settings.seed = seed;
  settings.device = device;
  if (!places.is_none()) settings.places = thinned_places(poses_from(places, "places"));
  settings.options = options_from(options, {"odometry", "relocaliser"});
  if (!settings.relocalise && settings.T_world_camera_start && settings.options.has("relocaliser")) {
    throw InputError("options", "relocaliser.* is not used with relocalise=False");
  }
  ImageInput input(camera_from(camera), color_order(order));
  const py::gil_scoped_release unlocked;
  return std::make_unique<HeldTracker>(map, std::move(input), settings);
}

py::dict track(HeldTracker& tracker, const py::object& image, double time) {
  const RawImage raw = tracker.input().take(image);
  TrackResult result;
  {
    const py::gil_scoped_release unlocked;
    result = tracker.track(raw, time);
  }
  const bool posed = result.status != TrackStatus::lost;
  py::dict pose;
  pose["time"] = time;
  pose["status"] = to_string(result.status);
  pose["T_world_camera"] = posed ? py::object(matrix_of(result.T_world_camera)) : py::none();
  pose["covariance"] = posed ? py::object(array_of(result.covariance)) : py::none();
  pose["in_map"] = result.in_map;
  pose["confirmed"] =
      result.evidence.verdict == Confirmation::none ? py::object(py::none()) : py::float_(result.evidence.probability);
  pose["keyframe"] = result.keyframe;
  pose["inlier_share"] = result.inlier_share;
  pose["map_share"] = result.map_share;
  pose["camera_shift"] = result.misfit;
  pose["milliseconds"] = result.milliseconds;
  return pose;
}

py::dict statistics(HeldTracker& tracker) {
  const OdometryStatistics s = tracker.statistics();
  py::dict row;
  row["frames"] = s.frames;
  row["posed"] = s.posed;
  row["lost"] = s.lost;
  row["relocalisations"] = s.relocalisations;
  row["keyframes"] = s.keyframes;
  row["confirmed"] = s.confirmed;
  row["refused"] = s.refused;
  row["likely_cause"] = s.likely_cause;
  return row;
}

void write(HeldTracker& tracker, const std::string& path) {
  const py::gil_scoped_release unlocked;
  write_trajectory(path, tracker.trajectory());
}

Trajectory trajectory(HeldTracker& tracker) {
  const py::gil_scoped_release unlocked;
  return tracker.trajectory();
}

}  // namespace

void bind_tracking(py::module_& m) {
  py::class_<HeldTracker>(m, "HeldTracker")
      .def("track", &track)
      .def("finish", &HeldTracker::finish, py::call_guard<py::gil_scoped_release>())
      .def("trajectory", [](HeldTracker& tracker) { return arrays_of(trajectory(tracker)); })
      .def("keyframe_times", &HeldTracker::keyframe_times, py::call_guard<py::gil_scoped_release>())
      .def("statistics", &statistics)
      .def("write_trajectory", &write);
  m.def("make_tracker", &make);
}

}  // namespace odosplat::python
