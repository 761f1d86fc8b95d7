// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "apps/cli/calibrate/calibrate_camera.hpp"
#include "apps/cli/check/check_camera.hpp"
#include "apps/cli/check/check_data.hpp"
#include "apps/command/json_text.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "apps/python/maps.hpp"
#include "apps/python/sequences.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/map/interpolation_view.hpp"

namespace odosplat::python {
namespace {

/// Of a file's name, which is read without the interpreter's lock, or of arrays.
PointCloud cloud_of(const py::object& value) {
  if (!py::isinstance<py::bytes>(value)) return cloud_from(value, "cloud");
  const auto file = value.cast<std::string>();
  const py::gil_scoped_release unlocked;
  return apps::read_cloud(file, 0.0, false);
}

/// The JSON of `odosplat check`.
std::string check(const HeldSequence& held, const py::object& cloud_value, int gap, int pairs) {
  ConventionOptions options;
  options.gap = gap;
  options.pairs = pairs;
  options.check();
  std::optional<PointCloud> cloud;
  if (!cloud_value.is_none()) cloud = cloud_of(cloud_value);
  const py::gil_scoped_release unlocked;
  apps::SequenceFlags flags{held.path, held.options};
  flags.options.as_stored = true;
  const Sequence sequence = Sequence::open(flags.path, flags.options);
  const bool with_depth = !apps::frames_with_depth(sequence).empty();
  if (!with_depth && !cloud) {
    throw InputError(sequence.name(), "has no depth: nothing to check the conventions by; a cloud will do");
  }
  apps::CheckResults results;
  if (with_depth) apps::check_by_depth(sequence, flags, options, results);
  if (cloud) results.cloud = apps::check_by_cloud(sequence, std::move(*cloud));
  results.texture = apps::texture_of(sequence);
  return apps::check_json(sequence, results, apps::checksum_of(sequence));
}

/// (fields of the camera, JSON of what was measured, verdict)
py::tuple calibrate(const HeldSequence& held, const std::shared_ptr<HeldMap>& map, const py::object& cloud_value,
                    const std::vector<std::string>& what, int pairs, const std::string& device) {
  for (const std::string& part : what) {
    const std::vector<std::string> known{"focal", "center", "distortion", "time", "line_time", "depth"};
    if (std::find(known.begin(), known.end(), part) == known.end())
      throw InputError("what", "must be some of focal, center, distortion, time, line_time, depth; has " + part);
  }
  std::optional<PointCloud> cloud;
  if (!cloud_value.is_none()) cloud = cloud_of(cloud_value);
  if (map && cloud) throw InputError("map", "and cloud cannot both be given");
  CameraFile file;
  std::string measured;
  std::string verdict;
  {
    const py::gil_scoped_release unlocked;
    std::unique_ptr<MapView> view;
    const CameraFit fit =
        apps::measure_calibration(held.sequence, {what, pairs, !map && !cloud},
                                  [&]() -> MapView& {
                                    if (cloud) view = std::make_unique<InterpolationView>(*cloud);
                                    if (map) view = std::make_unique<GaussianView>(open_device(device), map->map());
                                    return *view;
                                  },
                                  {});
    file = apps::calibrated_camera(held.sequence, fit);
    check_camera(held.sequence.name(), file);
    measured = apps::json_text(apps::camera_fit_json(fit, held.sequence.camera()));
    verdict = apps::camera_verdict(fit);
  }
  return py::make_tuple(fields_of(file), measured, verdict);
}

}  // namespace

void bind_checks(py::module_& m) {
  m.def("check", &check);
  m.def("calibrate", &calibrate);
}

}  // namespace odosplat::python
