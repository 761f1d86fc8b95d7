// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include <memory>
#include <mutex>

#include "apps/cli/relocalise/camera_watch.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "apps/python/maps.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"
#include "odosplat/splat/map_places.hpp"

namespace odosplat::python {
namespace {

/// A map with what looks single images up in it. One thread at a time; others wait.
class HeldRelocalizer {
 public:
  HeldRelocalizer(std::shared_ptr<HeldMap> map, ImageInput input, const std::vector<SE3>& places,
                  const RelocalizerOptions& options, const std::string& device)
      : map_(std::move(map)),
        input_(std::move(input)),
        view_(open_device(device), map_->map()),
        relocalizer_(input_.camera(), view_, places.empty() ? map_->places() : places, options),
        watch_(input_.camera(), view_) {}

  const ImageInput& input() const { return input_; }

  std::size_t prepare() {
    const std::lock_guard lock(mutex_);
    return relocalizer_.prepare();
  }

  Relocalization locate(const RawImage& image) {
    const std::lock_guard lock(mutex_);
    const GrayImage gray = input_.gray(image);
    Relocalization answer = relocalizer_.find(gray);
    if (!answer.found) return answer;
    const std::string fault = watch_.fault_of(watch_.add(gray, answer.T_world_camera));
    if (fault.empty()) return answer;
    Relocalization refused;
    refused.score = answer.score;
    refused.probability = answer.probability;
    refused.inlier_share = answer.inlier_share;
    refused.reason = fault;
    return refused;
  }

  std::string likely_cause() {
    const std::lock_guard lock(mutex_);
    return watch_.likely_cause();
  }

 private:
  std::shared_ptr<HeldMap> map_;
  ImageInput input_;
  GaussianView view_;
  Relocalizer relocalizer_;
  apps::CameraWatch watch_;
  std::mutex mutex_;
};

std::unique_ptr<HeldRelocalizer> make(const std::shared_ptr<HeldMap>& map, const py::object& camera,
                                      const std::string& order, const py::object& places,
                                      const std::vector<std::string>& lines, const std::string& device) {
  RelocalizerOptions options;
  options_from(lines, {"relocaliser"}).apply(options);
  const std::vector<SE3> given = places.is_none() ? std::vector<SE3>() : thinned_places(poses_from(places, "places"));
  ImageInput input(camera_from(camera), color_order(order));
  const py::gil_scoped_release unlocked;
  return std::make_unique<HeldRelocalizer>(map, std::move(input), given, options, device);
}

py::dict locate(HeldRelocalizer& relocalizer, const py::object& image) {
  const RawImage raw = relocalizer.input().take(image);
  Relocalization answer;
  {
    const py::gil_scoped_release unlocked;
    answer = relocalizer.locate(raw);
  }
  py::dict row;
  row["found"] = answer.found;
  row["T_world_camera"] = answer.found ? py::object(matrix_of(answer.T_world_camera)) : py::none();
  row["covariance"] = answer.found ? py::object(array_of(answer.covariance)) : py::none();
  row["probability"] = answer.probability;
  row["score"] = answer.score;
  row["inlier_share"] = answer.inlier_share;
  row["reason"] = answer.reason;
  return row;
}

}  // namespace

void bind_relocalisation(py::module_& m) {
  py::class_<HeldRelocalizer>(m, "HeldRelocalizer")
      .def("locate", &locate)
      .def("prepare", &HeldRelocalizer::prepare, py::call_guard<py::gil_scoped_release>())
      .def("likely_cause", &HeldRelocalizer::likely_cause, py::call_guard<py::gil_scoped_release>());
  m.def("make_relocalizer", &make);
}

}  // namespace odosplat::python
